// The environment seen through each pixel: bilinear and wrapping in longitude, by hand, because
// hardware filters with eight bits of fraction, too few next to a sun, and takes derivatives across
// the seam at longitude pi. shown() is that of player/render/picture_program.h.
uniform sampler2D environment;  // lat-long, row 0 on top, as in OpenEXR
uniform mat3 light_axes;        // right, up, backward of the camera, in the light's own frame
uniform vec2 half_extent;       // of the picture at distance 1: tan(fov / 2) * (aspect, 1)
uniform float strength;         // factor of the radiance
uniform vec2 region_corner;     // of the part of the picture that is drawn, lower left, 0 to 1
uniform vec2 region_size;       // of that part; 1 is the picture

in vec2 image_position;
out vec4 color;

const float kPi = 3.14159265358979;

vec3 texel(ivec2 at, ivec2 size) {
    int x = at.x < 0 ? at.x + size.x : (at.x >= size.x ? at.x - size.x : at.x);
    return texelFetch(environment, ivec2(x, clamp(at.y, 0, size.y - 1)), 0).rgb;
}

void main() {
    vec2 place_in_picture = region_corner + region_size * image_position;
    vec2 offset = (2.0 * place_in_picture - 1.0) * half_extent;
    vec3 direction = normalize(light_axes * vec3(offset, -1.0));

    float longitude = atan(direction.x, direction.z);
    // Near the poles asin would lose half the digits of the latitude.
    float latitude = atan(direction.y, length(direction.xz));
    ivec2 size = textureSize(environment, 0);
    vec2 place = vec2(0.5 - longitude / (2.0 * kPi), 0.5 - latitude / kPi) * vec2(size) - 0.5;
    vec2 corner = floor(place);
    vec2 weight = place - corner;
    ivec2 at = ivec2(corner);
    vec3 upper = mix(texel(at, size), texel(at + ivec2(1, 0), size), weight.x);
    vec3 lower = mix(texel(at + ivec2(0, 1), size), texel(at + ivec2(1, 1), size), weight.x);
    color = vec4(shown(strength * mix(upper, lower, weight.y)), 1.0);
}
