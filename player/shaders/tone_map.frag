// Linear radiance to display values: average the samples of a pixel, scale by the exposure, clamp,
// then the sRGB curve (gamma 0) or a power. The same curve as paim::ToneCurve.
uniform sampler2D picture;
uniform int samples;  // samples x samples of the picture make one pixel
uniform float scale;  // 2^exposure
uniform float gamma;

out vec4 display;

vec3 srgb(vec3 linear) {
    vec3 curve = 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
    return mix(curve, 12.92 * linear, vec3(lessThanEqual(linear, vec3(0.0031308))));
}

void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * samples;
    vec3 sum = vec3(0.0);
    for (int y = 0; y < samples; ++y) {
        for (int x = 0; x < samples; ++x) sum += texelFetch(picture, first + ivec2(x, y), 0).rgb;
    }
    vec3 linear = clamp(sum * (scale / float(samples * samples)), 0.0, 1.0);
    display = vec4(gamma == 0.0 ? srgb(linear) : pow(linear, vec3(1.0 / gamma)), 1.0);
}
