/* Layout of u_pass[], the array of vec4 constants of a pass, in the default block: reading a std140 block in a fragment shader
 * costs Mali load/store slots. Included by GLSL and by C: only #define and #ifdef, only comments of this kind.
 * A named component is constant[BIAS_SLOPE] in C and constant.BIAS_SLOPE in GLSL: an index costs up to seven instructions more
 * on embedded GPUs.
 * A code is a distance or depth as the shadow map encodes it (encoded distance). Penumbra depth grows with the distance from the
 * light such that a penumbra's radius is proportional to its difference between receiver and blocker (lib/shadow_place.glsl). */
#ifdef GL_ES
#define AT_X x
#define AT_Y y
#define AT_Z z
#define AT_W w
#else
#define AT_X 0
#define AT_Y 1
#define AT_Z 2
#define AT_W 3
#endif
#define PASS_CLIP 0       /* 4 columns of clip_from_world */
#define PASS_EYE 4        /* xyz: camera position, world space, or direction to it if w = 0; w: 1 perspective, 0 orthographic */
#define PASS_CODE 4       /* shadow passes: code = d * w + PASS_CODE_ADD.x; d: depth 0..1, or distance from xyz in metres */
#define PASS_CODE_ADD 5   /* shadow passes: x; y: code of the far end; z: depth maps of spots and points: code at infinity */
#define PASS_SKY 5        /* rgb: radiance of the upper hemisphere, after exposure; w: factor on the environment's radiance */
#define PASS_GROUND 6     /* rgb: radiance of the lower hemisphere, after exposure */
#define PASS_EXPOSURE 7   /* x: factor on emitted radiance; yzw: camera position, world space */
#define PASS_LIGHTS 8     /* GN_LIGHTS_MAX x LIGHT_SIZE */
#define LIGHT_SIZE 3
#define LIGHT_COLOR 0     /* rgb: illuminance (lux) or intensity (candela), over pi, after exposure; w: shadow strength 0..1 (lit.frag) */
#define LIGHT_PLACE 1     /* directional: xyz unit vector to the light; else position, world space; w: 1 / range, 0 = unlimited */
#define LIGHT_AXIS 2      /* spot: xyz unit vector of the direction of emission; w: cosine of the outer angle */
#define PASS_CONES 32     /* GN_LIGHTS_MAX in two vec4: 1 / (cos inner - cos outer) of light i in [i / 4][i % 4] */
#define PASS_SHADOWS 34   /* GN_SHADOWS_MAX x SHADOW_SIZE; slot i belongs to light i */
#define SHADOW_SIZE 11
#define SHADOW_MAP 0      /* directional, spot: 4 columns of map_from_world; cascades: xy in metres across the light, z code */
#define SHADOW_TILES 0    /* point, instead of SHADOW_MAP: xy: uv per unit of tangent */
#define SHADOW_BIAS 4
#define BIAS_NORMAL AT_X /* normal offset, plane units (texel size times texels); cascades: texels */
#define BIAS_SLOPE AT_Y /* slope offset, same unit; depth maps of spots and points: times the factor on 1 / depth */
#define BIAS_SLOPE_MAX AT_Z
#define BIAS_LEAST AT_Z /* spot, point: least cosine that the slope offset is divided by */
#define BIAS_FLAT 0.4f /* spot, point: 1 / cosine - this stands for the tangent */
#define BIAS_FOUR AT_W /* spot: four times BIAS_NORMAL */
#define BIAS_ULP AT_W /* one step of the encoding, metres; spots and points have it in CODE_OFFSET */
#define SHADOW_PLACE 5    /* xyz: position of the light, world space */
#define PLACE_CODE_SCALE AT_W /* code = distance * scale + CODE_OFFSET; depth maps of spots and points: scale / depth + CODE_OFFSET */
#define SHADOW_MAP_SIZE 6 /* xy: width and height of the map in texels; zw: 1 / width, 1 / height */
#define SHADOW_CODE 7
#define CODE_OFFSET AT_X
#define CODE_FAR_END AT_Y /* code of the far end: the clear value of the map */
#define CODE_REACH AT_Z /* tiles, SAT: largest read offset from a lookup, texels */
#define CODE_SHARED AT_W /* point: 1 - tangent over which adjacent tiles are blended */
#define CODE_HELD AT_W /* cascades: largest lookup offset from the centre of a tile, texels */
#define SHADOW_PENUMBRA 8 /* width of penumbrae: lib/shadow_place.glsl */
#define PENUMBRA_RADIUS AT_X /* of the emitter, texels per unit of penumbra depth; cascades: metres */
#define PENUMBRA_NEAREST AT_Y /* penumbra depth of the nearest caster; cascades: CASCADE_NEAREST */
#define PENUMBRA_GROWTH AT_Y /* cascades: largest penumbra depth per metre of view depth */
#define PENUMBRA_SCALE AT_Z /* penumbra depth = code * scale + bias */
#define PENUMBRA_BIAS AT_W
#define SHADOW_SLOPE 9    /* slope of a receiver's plane, depth codes (lib/shadow_place.glsl): two vec4, for u and v: xyz: dot with its
                             normal; point: xy of the first: factors on its normal in the tile's frame */
#define SLOPE_FILTER AT_W /* of the first: radius of the filter, texels; 0: the technique's */
#define SLOPE_HORIZON AT_W /* of the second: HORIZON_SLOPE / the lamp's radius; directional: / its tangent */
#define HORIZON_SLOPE 0.59f /* 0.5 + this * height in radii, within 0.04 of the share of a disk that is above a line */
#define PASS_SLIDES 78    /* GN_SLIDES_MAX x SLIDE_SIZE; a pass without slides or cascades ends here */
#define SLIDE_SIZE 4
#define SLIDE_U 0         /* dot with (p, 1), world space: u times w; u is 0..1 over the slide from its left edge */
#define SLIDE_V 1         /* dot with (p, 1): v times w; v is 0..1 from the top edge */
#define SLIDE_W 2         /* dot with (p, 1): w, the depth along the axis of the light, metres */
#define SLIDE_PLACE 3     /* xy: width and height in texels; z: depth of the slide (> 0); nearer points count as outside of it; w: depth of its far plane, 0: none */
#define PASS_CASCADES 94  /* GN_SHADOWS_MAX x CASCADES_SIZE, as PASS_SHADOWS; a pass without cascades or environment ends here */
#define CASCADES_SIZE 6   /* first one vec4 per cascade: xy: axis of the light, texels from the centre of the tile */
#define CASCADE_TEXEL AT_Z /* size of a texel, metres */
#define CASCADE_NEAREST AT_W /* penumbra depth of the nearest caster of the cascade */
#define CASCADES_ZONES 4  /* per cascade but the last: 1 / width of the zone that fades it into the next; 0: no next cascade */
#define CASCADES_SPANS 5  /* per cascade: range of penumbra depth that its moments cover, from the nearest caster */
#define CASCADE_FADE 0.1  /* width of the zone, which ends at the split, as a fraction of the distance of the split */
#define PASS_ENVIRONMENT 118 /* 9: xyz: coefficients of diffuse radiance (lib/environment.glsl); then x, y: cosine and sine of the
                                turn; a pass without an environment or a volume of occlusion ends before */
#define ENVIRONMENT_TURN 9
#define OCCLUSION_SCALE 10 /* xyz: from world space to coordinates of the volume of occlusion */
#define OCCLUSION_ADD 11   /* xyz: what is added then */
#define ENVIRONMENT_SIZE 12
#define PASS_SIZE 130
/* Filters of maps */
#define FILTER_RECT 0     /* xy: lower left texel of the tile; zw: upper right texel, inclusive */
#define FILTER_BLUR 1     /* x: half of the box width, texels; y: offset of the last texel from the centre; z: 1 / width */
#define FILTER_SIZE 2     /* xy: width and height of the map in texels; zw: their inverse */
#define FILTER_TABLE 3    /* x: largest read offset from a lookup in the SAT, texels; y: column of the tile's first block sum */
#define FILTER_CODE 4     /* code * x + y: 0..1 over the range that moments cover */
#define FILTER_CONE 5     /* x: texels of a cone's radius per unit of code; y, z: how far a step reads, texels of the cone map and of the map */
#define FILTER_FLOOR 6    /* x, y: shares of the light that occlusion and shadows can take; z: weight over what is there */
#define FILTER_FLOOR_X 7  /* xyz: dot with (uv, 1): x over the floor's square, -1..1; w: visibility = code * w + FILTER_FLOOR_Z.w */
#define FILTER_FLOOR_Z 8  /* xyz: the same for z */
#define FILTER_CONSTANTS 9
/* Summed-area tables (SAT) */
#define TABLE_BLOCK 16    /* texels per block; rows and columns are summed within blocks, sums of whole blocks are added later */
/* Fixed-point scale of moments 0..1: the sum over a square with half side `reach` texels fits into 32 bits */
#define TABLE_SCALE(reach) (4294966272.0f / ((2.0f * (reach) + 2.0f) * (2.0f * (reach) + 2.0f)) - 1.0f)
/* Cone maps (shadow/cone.glsl) */
#define CONE_FAR 60000.0  /* texels: where nothing blocks; a half float */
#define CONE_WIDEST 510.0 /* texels: steps of 128 to 1 texels of the cone map reach as far */
/* Casters projected onto the plane: PASS_CLIP, and */
#define FLAT_PLANE 4      /* dot with (p, 1), world space: height above the plane, metres */
#define FLAT_HEIGHTS 5    /* x, y: lowest and highest point that casts, metres */
/* Light gizmos: PASS_CLIP, and */
#define MARK_PIXEL 4      /* xy: size of a pixel of the gizmo in NDC (-1..1) */
#define MARK_QUADS 105    /* a disc and 104 lines */
#define MARK_HALO 1.5     /* width of the dark outline, pixels */
/* Panels */
#define PANEL_RECT 0      /* xy: lower left corner, zw: upper right one, -1..1 */
#define PANEL_GREY 1      /* grey = clamp(code * x + y, 0, 1) ^ z */
#define PANEL_FRAME 2     /* rgb: linear; w: width, pixels */
#define PANEL_PX 3        /* xy: width and height, pixels; zw: cosine and sine of the output's clockwise rotation */
#define PANEL_SIZE 4
/* The environment as the background */
#define BACKDROP_RAYS 0   /* xyz of three, in the environment's frame: direction at the centre of NDC, per unit of x, of y */
#define BACKDROP_LIGHT 3  /* x: factor on its radiance; y: level of the cube */
#define BACKDROP_SIZE 4
/* An unseen floor whose alpha is in a texture */
#define FLOOR_PLACE 0     /* clip space: of u = v = 0, per u, per v */
#define FLOOR_SHOWN 3     /* xy: least uv; zw: greatest */
#define FLOOR_SIZE 4
/* The last pass */
#define ENCODE_BACKGROUND 0 /* rgb: linear */
#define ENCODE_SIZE 1

#define MEAN_SHARE 0 /* x: of the picture in the mean, or of the mean in the picture; y: what is brighter is cut */
#define MEAN_SIZE 1
/* Captions */
#define CAPTION_PX 0      /* xy: size of a pixel in NDC (-1..1); zw: cosine and sine of the output's clockwise rotation */
#define CAPTION_SIZE 1
#define CAPTION_SHADE 0.3 /* transmittance of a background, sRGB-encoded: contrast of white text is at least 8 (WCAG 2.1) */
