// Where vertices find their data: what all shaders that decode share.
//
// All data lie in 2D textures (player/gl/data_texture.h). A texel holds four values of one vertex.
// Integers count steps, by which the uniforms and the light are multiplied. The last components, as
// far as they are 8-bit integers, are in a texture of these ("int8"), those before them in one of
// 16-bit integers or, where the file holds floats, of floats ("int16"): #defines say which samplers
// these take (player/render/low_rank_textures.h).
// Components:   texel = (k * groups + j) * num_vertices + v, j counting groups of four planes,
//               channel after channel
// Coefficients: texel = j * num_vertices + v, j counting groups of four components of vertices
uniform int width_log2;  // of every texture
uniform int num_vertices;

ivec2 place(int texel) { return ivec2(texel & ((1 << width_log2) - 1), texel >> width_log2); }

vec4 fetch(sampler2D data, int texel) { return texelFetch(data, place(texel), 0); }

vec4 fetch(isampler2D data, int texel) { return vec4(texelFetch(data, place(texel), 0)); }

