// The colour of an image times the radiance of a white surface. shown() is that of
// player/render/picture_program.h. Levels are chosen and mixed here, because drivers round and shorten the mix in
// ways of their own: paim::MipPyramid does the same on the CPU.
// Based on: The OpenGL 4.6 Specification, section 8.14.1
uniform sampler2D image;  // sRGB, so that samples are linear
uniform int num_levels;
uniform vec3 factor;

in vec3 white_radiance;
in vec2 image_place;
out vec4 color;

vec3 image_color() {
    vec2 size = vec2(textureSize(image, 0));
    vec2 per_x = dFdx(image_place) * size;
    vec2 per_y = dFdy(image_place) * size;
    float squared = max(dot(per_x, per_x), dot(per_y, per_y));
    float level = min(0.5 * log2(max(squared, 1.0)), float(num_levels - 1));
    float finer = floor(level);
    return mix(textureLod(image, image_place, finer).rgb, textureLod(image, image_place, finer + 1.0).rgb,
               level - finer);
}

void main() {
    color = vec4(shown(white_radiance * factor * image_color() + gloss_radiance()), 1.0);
}
