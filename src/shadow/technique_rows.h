/* The table of shadow techniques: a row each, of GN_TECHNIQUE_NAME and its struct gn_technique_row.
 * One row and its GLSL file add a technique. Includers define ROW; technique.h makes the
 * enumerators. */
ROW(NONE, .name = "none", .title = "No shadows", .offered = true, .rank = 19, .what = "no shadows")
ROW(HARD, .name = "hard", .title = "Sharp shadows", .rank = 17, .file = "shadow/hard.glsl",
    .reads_distance = true, .radius_texels = 1, .bias_texels = 0.6f, .what = "one comparison",
    .source = "Williams 1978")
ROW(PCF, .name = "pcf", .title = "Sharp shadows", .offered = true, .rank = 1,
    .file = "shadow/pcf.glsl", .compares_linear = true, .one_code = true, .filter_radius_px = 1.5f,
    .filter_most = 2.0f, .radius_texels = 2, .bias_texels = 0.9f,
    .what = "four hardware-compare taps half a texel away", .source = "Reeves, Salesin, Cook 1987")
ROW(PCF2, .name = "pcf2", .title = "Sharp shadows", .rank = 11, .file = "shadow/pcf2.glsl",
    .compares_linear = true, .one_code = true, .radius_texels = 1, .bias_texels = 0.7f,
    .what = "one hardware-compare tap", .source = "Reeves, Salesin, Cook 1987")
ROW(PCF3, .name = "pcf3", .title = "Smooth shadows", .rank = 12, .file = "shadow/pcf3.glsl",
    .compares_linear = true, .one_code = true, .radius_texels = 2, .bias_texels = 1.15f,
    .what = "[1 2 1] squared in four fetches", .source = "Reeves, Salesin, Cook 1987")
ROW(PCF5, .name = "pcf5", .title = "Smooth shadows", .rank = 13, .file = "shadow/pcf5.glsl",
    .compares_linear = true, .one_code = true, .radius_texels = 3, .bias_texels = 1.65f,
    .what = "[1 3 4 3 1] squared in nine fetches", .source = "Reeves, Salesin, Cook 1987")
ROW(BOX3, .name = "box3", .title = "Smooth shadows", .rank = 14, .file = "shadow/box3.glsl",
    .compares_linear = true, .one_code = true, .radius_texels = 2, .bias_texels = 1.3f,
    .what = "equal weights over 3 x 3 texels in four fetches",
    .source = "Reeves, Salesin, Cook 1987")
ROW(BOX5, .name = "box5", .title = "Smooth shadows", .rank = 15, .file = "shadow/box5.glsl",
    .compares_linear = true, .one_code = true, .radius_texels = 3, .bias_texels = 1.9f,
    .what = "equal weights over 5 x 5 texels in nine fetches",
    .source = "Reeves, Salesin, Cook 1987")
ROW(DISK, .name = "disk", .title = "Smooth shadows", .rank = 10, .file = "shadow/disk.glsl",
    .compares_linear = true, .reads_distance = true, .taps = GN_TAPS_DISK, .filter_radius_px = 3.0f,
    .filter_most = 32.0f, .radius_texels = 4, .bias_texels = 0.7f,
    .what = "16 taps over a disk, turned from pixel to pixel", .source = "Vogel 1979")
ROW(POISSON, .name = "poisson", .title = "Smooth shadows", .rank = 9, .file = "shadow/poisson.glsl",
    .compares_linear = true, .reads_distance = true, .taps = GN_TAPS_POISSON,
    .filter_radius_px = 3.0f, .filter_most = 32.0f, .radius_texels = 4, .bias_texels = 0.7f,
    .what = "16 taps over a Poisson disk, turned from pixel to pixel", .source = "Bridson 2007")
ROW(WHITE, .name = "white", .title = "Smooth shadows", .rank = 16, .file = "shadow/white.glsl",
    .compares_linear = true, .reads_distance = true, .taps = GN_TAPS_DISK, .filter_radius_px = 3.0f,
    .filter_most = 32.0f, .radius_texels = 4, .bias_texels = 0.7f,
    .what = "16 random taps over a disk, others in each pixel", .source = "Cook 1986")
ROW(PCSS, .name = "pcss", .title = "Soft shadows", .rank = 3, .file = "shadow/pcss.glsl",
    .searches = true, .reads_distance = true, .soft = true, .taps = GN_TAPS_DISK,
    .radius_texels = 2, .bias_texels = 0.7f,
    .what = "finds the blockers, then filters as wide as their penumbra is",
    .source = "Fernando 2005")
ROW(CONE, .name = "cone", .title = "Soft shadows", .offered = true, .rank = 2,
    .file = "shadow/cone.glsl", .compares_linear = true, .soft = true, .taps = GN_TAPS_RINGS,
    .filter = GN_FILTER_CONE, .reads_both = true,
    .stores = {GN_MOMENTS_CONE_RG16F, GN_MOMENTS_CONE_BITS, GN_MOMENTS_CONE_BYTES},
    .fallback = GN_TECHNIQUE_PCSS, .radius_texels = 2, .bias_texels = 0.7f,
    .what = "one read finds the blocker, then hardware compares as wide as its penumbra",
    .source = "Rong, Tan 2006; Fernando 2005")
ROW(VSM, .name = "vsm", .title = "Smooth shadows", .rank = 8, .file = "shadow/vsm.glsl",
    .filter = GN_FILTER_BLUR, .moments = "moments/vsm.glsl", .moments_middle = 0.5f,
    .stores = {GN_MOMENTS_RG32UI, GN_MOMENTS_RGBA16UI, GN_MOMENTS_RGBA16F, GN_MOMENTS_RGBA16F_MIPS},
    .radius_texels = 6, .bias_texels = 1.0f,
    .what = "two moments of a blurred map, Chebyshev's inequality",
    .source = "Donnelly, Lauritzen 2006")
ROW(EVSM, .name = "evsm", .title = "Smooth shadows", .rank = 7, .file = "shadow/evsm.glsl",
    .filter = GN_FILTER_BLUR, .moments = "moments/evsm.glsl", .stores = {GN_MOMENTS_RGBA32F_SHARE},
    .radius_texels = 6, .bias_texels = 1.0f,
    .what = "the same of exponents of the distance, from both ends",
    .source = "Lauritzen, McCool 2008")
ROW(MSM, .name = "msm", .title = "Smooth shadows", .rank = 6, .file = "shadow/msm.glsl",
    .filter = GN_FILTER_BLUR, .moments = "moments/msm.glsl", .moments_middle = 0.5f,
    .stores = {GN_MOMENTS_RGBA16UI, GN_MOMENTS_RGBA32F_BITS, GN_MOMENTS_RGBA16F},
    .radius_texels = 6, .bias_texels = 1.0f,
    .what = "four moments of a blurred map, the Hamburger bound", .source = "Peters, Klein 2015")
ROW(VSSM, .name = "vssm", .title = "Soft shadows", .rank = 5, .file = "shadow/vssm.glsl",
    .soft = true, .filter = GN_FILTER_TABLE, .moments = "moments/vsm.glsl",
    .stores = {GN_MOMENTS_TABLE_RGBA32UI}, .map_px = 512, .radius_texels = 2, .bias_texels = 0.7f,
    .what = "blockers and penumbra from sums of two moments, at one cost for all widths",
    .source = "Yang et al. 2010")
ROW(SMSM, .name = "smsm", .title = "Soft shadows", .rank = 4, .file = "shadow/smsm.glsl",
    .soft = true, .filter = GN_FILTER_TABLE, .moments = "moments/smsm.glsl",
    .stores = {GN_MOMENTS_TABLE_RGBA32UI}, .map_px = 512, .radius_texels = 2, .bias_texels = 0.7f,
    .what = "the same from four moments", .source = "Peters et al. 2017")
ROW(PLANAR, .name = "planar", .title = "Shadows on the floor", .rank = 18,
    .file = "shadow/planar.glsl", .on_plane = true, .radius_texels = 2,
    .what = "casters flattened on the scene's plane, nowhere else", .source = "Blinn 1988")
