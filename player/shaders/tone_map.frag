// The picture as display values: the mean of the samples of each pixel through the tone curve.
uniform sampler2D picture;
uniform int samples;  // samples x samples of the picture make one pixel

out vec4 display;

void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * samples;
    vec3 sum = vec3(0.0);
    for (int y = 0; y < samples; ++y) {
        for (int x = 0; x < samples; ++x) sum += texelFetch(picture, first + ivec2(x, y), 0).rgb;
    }
    display = vec4(tone_curve(sum / float(samples * samples)), 1.0);
}
