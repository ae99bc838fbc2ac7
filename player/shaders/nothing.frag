// For programs whose vertices are captured and never drawn.
out vec4 nothing;

void main() { nothing = vec4(0.0); }
