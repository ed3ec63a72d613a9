// Light gizmo, built of quads from gl_VertexID: a disc at the position, lines for type and extent. Point: eight rays and, with a
// range, three circles of that radius. Spot: the cone, with its end circle if there is a range. Directional: a sun with an arrow.
// Disc radius, ray length and line width are in pixels.
#include "lib/pass.glsl"
#include "lib/vertex.glsl"

flat out vec4 v_hue;        // rgb linear, alpha
flat out float v_half;      // radius of the disc or half width of a line, pixels
out vec3 v_local;           // disc: xy from its centre, pixels; line: x across, pixels, z along, 0..1
flat out float v_fades;     // 1: fades to transparent at the end of the line
flat out float v_disc;      // 1: the disc, 0: a line

const float DISC_PX = 7.0;
const float LINE_PX = 1.1;
const float TURN = 6.2831853;
const int ROUND = 32;       // lines per circle

// End of a line: a point in the space of the gizmo, metres, and an offset from it in pixels.
struct line_end {
    vec3 at;
    vec2 px;
};

vec3 on_circle(int i, float radius) {
    float angle = float(i) * (TURN / float(ROUND));
    return vec3(radius * cos(angle), radius * sin(angle), 0.0);
}

line_end ray_end(int i, bool outer) {
    float angle = float(i) * (TURN / 8.0);
    return line_end(vec3(0.0), (outer ? 15.0 : 10.5) * vec2(cos(angle), sin(angle)));
}

// Three circles, each normal to an axis.
line_end ball_end(int i, bool last, float radius) {
    vec3 p = on_circle(i % ROUND + (last ? 1 : 0), radius);
    int circle = i / ROUND;
    return line_end(circle == 0 ? p.xyz : circle == 1 ? p.zxy : p.yzx, vec2(0.0));
}

line_end cone_end(int i, bool last, float depth, float tangent) {
    vec3 foot = vec3(0.0, 0.0, depth);
    if (i < ROUND) return line_end(foot + on_circle(i + (last ? 1 : 0), depth * tangent), vec2(0.0));
    if (i == ROUND + 8) return line_end(last ? foot : vec3(0.0), vec2(0.0));
    return line_end(last ? foot + on_circle((i - ROUND) * 4, depth * tangent) : vec3(0.0), vec2(0.0));
}

// A shaft, and four lines for the head.
line_end arrow_end(int i, bool last, float size) {
    vec3 tip = vec3(0.0, 0.0, size);
    if (i == 0) return line_end(last ? tip : vec3(0.0), vec2(0.0));
    return line_end(last ? vec3(on_circle(i * 8, 0.12 * size).xy, 0.8 * size) : tip, vec2(0.0));
}

// Line i, 0..MARK_QUADS - 2; lines that the gizmo does not use have length 0.
line_end mark_end(int i, bool last) {
    line_end none = line_end(vec3(0.0), vec2(0.0));
    float size = a_surface.y;
    bool limited = a_surface.w > 0.5;
    if (int(a_surface.x) == LIGHT_SPOT) return i > ROUND + 8 || (i < ROUND && !limited) ? none : cone_end(i, last, size, a_surface.z);
    if (i < 8) return ray_end(i, last);
    if (int(a_surface.x) == LIGHT_DIRECTIONAL) return i > 12 ? none : arrow_end(i - 8, last, size);
    return limited ? ball_end(i - 8, last, size) : none;
}

vec4 clip_of(vec3 p) {
    vec4 at = vec4(p, 1.0);
    return pass_matrix(PASS_CLIP) * vec4(dot(a_world_0, at), dot(a_world_1, at), dot(a_world_2, at), 1.0);
}

// Moves a along the line to b to the front of the camera.
vec4 before_eye(vec4 a, vec4 b) {
    const float least = 0.001;
    return a.w < least && b.w > least ? mix(a, b, (least - a.w) / (b.w - a.w)) : a;
}

void main() {
    vec2 pixel = u_pass[MARK_PIXEL].xy;
    int quad = gl_VertexID / 6;
    bool disc = quad == MARK_QUADS - 1; // drawn last, over the lines
    int corner = gl_VertexID % 6;
    corner = corner < 3 ? corner : corner == 3 ? 2 : corner == 4 ? 1 : 3; // two triangles: 0 1 2, 2 1 3
    bool last = corner >= 2;
    float side = corner % 2 == 0 ? -1.0 : 1.0;
    line_end a = disc ? line_end(vec3(0.0), vec2(0.0)) : mark_end(quad, false);
    line_end b = disc ? a : mark_end(quad, true);
    vec4 from = clip_of(a.at), to = clip_of(b.at);
    vec4 clip_a = before_eye(from, to), clip_b = before_eye(to, from);
    bool seen = min(clip_a.w, clip_b.w) > 0.0;
    vec2 p = clip_a.xy / clip_a.w / pixel + a.px, q = clip_b.xy / clip_b.w / pixel + b.px;
    vec2 along = q - p;
    float length_px = length(along);
    v_disc = disc ? 1.0 : 0.0;
    v_half = disc ? DISC_PX : LINE_PX;
    v_fades = !disc && int(a_surface.x) == LIGHT_SPOT && a_surface.w < 0.5 ? 1.0 : 0.0;
    v_hue = a_base_color;
    float reach = v_half + MARK_HALO;
    along = disc ? vec2(0.0, 1.0) : along / max(length_px, 1e-6);
    vec2 across = vec2(along.y, -along.x) * side * reach;
    v_local = vec3(side * reach, disc ? (last ? reach : -reach) : 0.0, last ? 1.0 : 0.0);
    vec2 at = (last ? q : p) + across;
    if (disc) at += vec2(0.0, v_local.y);
    float z = last ? clip_b.z / clip_b.w : clip_a.z / clip_a.w;
    if (a_base_color.a < 1.0) z = -1.0; // the translucent copy ignores depth
    gl_Position = seen && (disc || length_px > 0.01) ? vec4(at * pixel, z, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
