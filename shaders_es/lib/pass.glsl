// The constants of the pass. Layout: blocks.glsl. src/frame/ fills them. Picture: gn_frame_eye() (eye.c), set_picture_constants()
// (frame.c), gn_frame_light_constants() (constants.c), gn_frame_slide_constants() (slides.c). Shadow maps:
// gn_frame_shadow_constants() (constants.c). Other passes: filter_constants() (filter.c), fall_constants() (stencil.c),
// backdrop.c, overlay.c, caption.c.
uniform vec4 u_pass[PASS_SIZE];

#ifndef PASS
#define PASS(i) u_pass[i]
#endif

// The matrix whose first column is u_pass[first].
mat4 pass_matrix(const int first) {
    return mat4(u_pass[first], u_pass[first + 1], u_pass[first + 2], u_pass[first + 3]);
}
