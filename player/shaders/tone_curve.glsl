// Linear radiance to display values, the same curve as paim::ToneCurve: scale by the exposure, the
// operator, then the sRGB curve (gamma 0) or a power. with_tone_curve() puts this file and the
// constants kReinhard, kAces and kLargestExposed in front of a fragment shader.
uniform float tone_scale;  // 2^exposure
uniform float tone_gamma;
uniform int tone_operator;

vec3 srgb(vec3 linear) {
    vec3 curve = 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
    return mix(curve, 12.92 * linear, vec3(lessThanEqual(linear, vec3(0.0031308))));
}

vec3 tone_curve(vec3 radiance) {
    vec3 x = clamp(radiance * tone_scale, 0.0, kLargestExposed);
    if (tone_operator == kReinhard) {
        x /= 1.0 + x;
    } else if (tone_operator == kAces) {
        x *= (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
    }
    x = min(x, 1.0);
    return tone_gamma == 0.0 ? srgb(x) : pow(x, vec3(1.0 / tone_gamma));
}
