/* Where things lie in u_pass[], the one array of constants that a pass gives to its programs (vec4 each, default block: a
 * std140 block read in a fragment shader costs Mali load/store slots). Read by GLSL and by C, so it holds only #define.
 * A component with a name of its own is constant[BIAS_SLOPE] in C and constant.BIAS_SLOPE in GLSL: compilers of boards need up to
 * seven instructions more for an index. */
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
#define PASS_EYE 4        /* xyz: eye, world space, or direction to it if w = 0; w: 1 perspective, 0 orthographic */
#define PASS_CODE 4       /* shadow passes: w, factor on the depth (0..1), or on the distance from xyz (metres) */
#define PASS_CODE_ADD 5   /* shadow passes: x is added to that: the code */
#define PASS_SKY 5        /* rgb: hemisphere's upper radiance, after exposure */
#define PASS_GROUND 6     /* rgb: lower */
#define PASS_EXPOSURE 7   /* x: factor on emitted radiance; yzw: position of the eye, world space */
#define PASS_LIGHTS 8     /* GN_LIGHTS_MAX x LIGHT_SIZE */
#define LIGHT_SIZE 3
#define LIGHT_COLOR 0     /* rgb: illuminance (lux) or intensity (candela), over pi, after exposure; w: shadow strength 0..1 */
#define LIGHT_PLACE 1     /* directional: xyz unit vector to the light; else position, world space; w: 1 / range, 0 = unlimited */
#define LIGHT_AXIS 2      /* spot: xyz unit vector along which it shines; w: cosine of the outer angle */
#define PASS_CONES 32     /* GN_LIGHTS_MAX in two vec4: 1 / (cos inner - cos outer) of light i in [i / 4][i % 4] */
#define PASS_SHADOWS 34   /* GN_SHADOWS_MAX x SHADOW_SIZE; slot i belongs to light i */
#define SHADOW_SIZE 9
#define SHADOW_MAP 0      /* directional, spot: 4 columns of map_from_world; cascades: of metres across the light and code */
#define SHADOW_TILES 0    /* point, in its place - xy: uv of a tangent of 1; zw: the code of a depth map at depth d is z + w / d */
#define SHADOW_BIAS 4
#define BIAS_NORMAL AT_X /* normal offset, plane units (texel times texels); cascades: texels */
#define BIAS_SLOPE AT_Y /* slope offset, the same */
#define BIAS_SLOPE_MAX AT_Z
#define BIAS_ULP AT_W /* metres */
#define SHADOW_PLACE 5    /* xyz: position of the light; */
#define PLACE_CODE_SCALE AT_W /* factor on a distance: its code, less CODE_OFFSET */
#define SHADOW_MAP_SIZE 6 /* xy: width and height of the map in texels; zw: 1 / width, 1 / height */
#define SHADOW_CODE 7
#define CODE_OFFSET AT_X
#define CODE_FAR_END AT_Y /* the far end's code: what the map is cleared to */
#define CODE_REACH AT_Z /* tiles, SAT: how far beside a place may be read, texels */
#define CODE_SHARED AT_W /* point: tangent over which tiles are mixed */
#define CODE_HELD AT_W /* cascades: how far from a tile's middle it may be read, texels */
#define SHADOW_PENUMBRA 8 /* how wide a penumbra is: lib/shadow_place.glsl */
#define PENUMBRA_RADIUS AT_X /* of the emitter, texels per unit of penumbra depth; cascades: metres */
#define PENUMBRA_NEAREST AT_Y /* penumbra depth of the nearest caster; not with cascades */
#define PENUMBRA_GROWTH AT_Y /* cascades: penumbra depth per metre along the view */
#define PENUMBRA_SCALE AT_Z /* penumbra depth = code * scale + bias */
#define PENUMBRA_BIAS AT_W
#define PASS_SLIDES 70    /* GN_SLIDES_MAX x SLIDE_SIZE; a pass without slides or cascades ends here */
#define SLIDE_SIZE 4
#define SLIDE_U 0         /* of a point (p, 1), world space: u times w, 0..1 over the slide from its left edge */
#define SLIDE_V 1         /* v times w, from its top edge */
#define SLIDE_W 2         /* w: depth along the light's axis, metres */
#define SLIDE_PLACE 3     /* xy: width and height in texels; z: depth of the slide, over 0: what is nearer has not passed it */
#define PASS_CASCADES 86  /* GN_SHADOWS_MAX x CASCADES_SIZE, as PASS_SHADOWS; a pass without cascades ends here */
#define CASCADES_SIZE 6   /* four, each - xy: the light's axis, texels from the middle of its tile; */
#define CASCADE_TEXEL AT_Z /* metres */
#define CASCADE_NEAREST AT_W /* penumbra depth of its nearest caster; */
#define CASCADES_ZONES 4  /* of the first three: 1 / width of the zone in which each fades into the next, 0: there is none */
#define CASCADES_SPANS 5  /* of each: penumbra depth that its moments cover, from that of its nearest caster on */
#define CASCADE_FADE 0.1  /* width of that zone, up to the split, as a share of the split's distance */
#define PASS_SIZE 110
/* Filters of maps */
#define FILTER_RECT 0     /* xy: lower left texel of the tile, zw: upper right one, both in it */
#define FILTER_BLUR 1     /* x: half the width of the box, texels; y: its last texel, from the middle; z: 1 / width */
#define FILTER_SIZE 2     /* xy: width and height of the map in texels; zw: their inverse */
#define FILTER_TABLE 3    /* x: how far from a place the table is read, texels; y: where the tile's sums of blocks begin, from the left */
#define FILTER_CODE 4     /* x: factor on a code, y: is added: 0..1 of what moments span */
#define FILTER_CONSTANTS 5
/* Summed-area tables */
#define TABLE_BLOCK 16    /* texels that are summed at once; sums of whole blocks make good for the rest */
/* Of moments 0..1 in fixed point: so many texels' sum fits into 32 bits as lie in a square that reaches `reach` texels from its middle */
#define TABLE_SCALE(reach) (4294966272.0f / ((2.0f * (reach) + 2.0f) * (2.0f * (reach) + 2.0f)) - 1.0f)
/* Casters fallen on the plane: PASS_CLIP, and */
#define FLAT_PLANE 4      /* height over the plane: dot with (p, 1), world space */
#define FLAT_HEIGHTS 5    /* x, y: between these a point casts, metres */
/* Marks: PASS_CLIP, and */
#define MARK_PIXEL 4      /* xy: a pixel of the mark, of 2 x 2 */
#define MARK_QUADS 105    /* a disc and 104 lines */
#define MARK_HALO 1.5     /* pixels: dark edge round everything */
/* Panels */
#define PANEL_RECT 0      /* xy: lower left corner, zw: upper right one, -1..1 */
#define PANEL_GREY 1      /* grey = clamp(code * x + y, 0, 1) ^ z */
#define PANEL_FRAME 2     /* rgb: linear; w: width, pixels */
#define PANEL_PX 3        /* xy: width and height, pixels; zw: cosine and sine of its turn, clockwise */
#define PANEL_SIZE 4
/* Captions */
#define CAPTION_PX 0      /* xy: a pixel of the picture, of 2 x 2; zw: cosine and sine of its turn, clockwise */
#define CAPTION_SIZE 1
#define CAPTION_SHADE 0.3 /* a ground leaves so much of what is under it, as sRGB encodes that: white on it has 8 times the light of it and more (WCAG 2.1) */
