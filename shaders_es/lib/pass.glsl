// The constants of the pass, and matrices out of them. Layout: blocks.glsl.
uniform vec4 u_pass[PASS_SIZE];

#ifndef PASS
#define PASS(i) u_pass[i]
#endif

// The matrix whose four columns begin at u_pass[first].
mat4 pass_matrix(const int first) {
    return mat4(u_pass[first], u_pass[first + 1], u_pass[first + 2], u_pass[first + 3]);
}
