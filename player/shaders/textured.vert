// A corner of a face with an image: the number of its vertex, whose position and white radiance lie in textures, and
// its place in the image. Corners of a vertex may have several places. vertex_data.glsl is in front of this file.
layout(location = 0) in uint vertex;
layout(location = 1) in vec2 place_in_image;

uniform sampler2D positions;
uniform sampler2D white_radiances;
uniform mat4 clip_from_local;

invariant gl_Position;  // faces with and without images meet without gaps

out vec3 white_radiance;
out vec2 image_place;

void main() {
    white_radiance = fetch(white_radiances, int(vertex)).rgb;
    image_place = place_in_image;
    vec3 position = fetch(positions, int(vertex)).xyz;
    pass_gloss(int(vertex), position);
    gl_Position = clip_from_local * vec4(position, 1.0);
}
