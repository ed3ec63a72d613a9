// Vertex shader of lit.frag and aov.frag. Sets v_shadow[slot] where SHADOW_LINEAR or SHADOW_PROJECTED[slot] (see lit.frag).
#include "lib/pass.glsl"
#include "lib/vertex.glsl"
#include "lib/shadow_point.glsl"
#include "lib/environment.glsl"

invariant gl_Position; // additive passes draw the same surfaces again and need the same depth (LEQUAL)

#ifdef WITH_VERTEX_COLOR
out vec4 v_color;
#else
flat out vec4 v_color;
#endif
out vec3 v_position;
out vec3 v_normal;
#ifdef WITH_SPREAD
out float v_spread;
#endif
#define DECLARE_UV(u_texture, v_uv, slot, second) out vec2 v_uv;
EACH_TEXTURE(DECLARE_UV)
#ifdef WITH_NORMAL_TEXTURE
out vec3 v_tangent;
flat out float v_bitangent_sign;
#endif
flat out vec4 v_surface;
flat out vec4 v_emissive;
#ifdef WITH_FLAT_CONSTANTS
flat out vec4 v_constant[7]; // lib/flat_constants.glsl
#endif
#ifdef WITH_SHADOWS
out vec3 v_shadow[SHADOW_COUNT];
#endif
#ifdef WITH_IRRADIANCE // lib/environment.glsl
out vec3 v_irradiance;
#ifdef WITH_DOUBLE_SIDED
out vec3 v_irradiance_odd;
#endif
#endif
#ifdef WITH_OCCLUDED
out vec3 v_cell; // in the volume of occlusion, 0..1
#endif

#define PLACE_SHADOW(slot) \
    v_shadow[slot] = SHADOW_LINEAR[slot] \
        ? shadow_point_directional(slot, p, n, u_pass[PASS_LIGHTS + slot * LIGHT_SIZE + LIGHT_PLACE].xyz, \
                                   SHADOW_SPREAD[slot] ? spread : 0.0) \
        : SHADOW_PROJECTED[slot] ? shadow_point_spot(slot, p, n, spread) : vec3(0.0);

#define SET_UV(u_texture, v_uv, slot, second) v_uv = slot_uv(slot, second);

void main() {
    vec3 p = position_ws();
    vec3 n = normalize(normal_ws());
    gl_Position = pass_matrix(PASS_CLIP) * vec4(p, 1.0);
    v_position = p;
    v_normal = n;
#ifdef WITH_NORMAL_TEXTURE
    vec4 tangent = tangent_ws();
    v_tangent = tangent.xyz;
    v_bitangent_sign = tangent.w;
#endif
#ifdef WITH_OCCLUDED
    v_cell = p * u_pass[PASS_ENVIRONMENT + OCCLUSION_SCALE].xyz + u_pass[PASS_ENVIRONMENT + OCCLUSION_ADD].xyz;
#endif
    float spread = normal_spread();
#ifdef WITH_SPREAD
    v_spread = spread;
#endif
    v_color = VERTEX_COLOR ? a_base_color * a_color : a_base_color;
    v_surface = a_surface;
    v_emissive = a_emissive;
    EACH_TEXTURE(SET_UV)
#ifdef WITH_FLAT_CONSTANTS
    v_constant = vec4[7](u_pass[PASS_SKY], u_pass[PASS_GROUND], u_pass[PASS_EYE], u_pass[PASS_LIGHTS + LIGHT_COLOR],
                         u_pass[PASS_LIGHTS + LIGHT_PLACE], u_pass[PASS_SHADOWS + SHADOW_MAP_SIZE],
                         u_pass[PASS_SHADOWS + SHADOW_CODE]);
#endif
    EACH_SHADOWED_LIGHT_VERTEX(PLACE_SHADOW)
#ifdef WITH_IRRADIANCE
    vec3 odd;
    environment_diffuse(n, v_irradiance, odd);
#ifdef WITH_DOUBLE_SIDED
    v_irradiance_odd = odd;
#else
    v_irradiance += odd;
#endif
#endif
}
