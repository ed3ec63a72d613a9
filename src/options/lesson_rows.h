/* The table of lessons, in the order in which they teach: LESSON(fields of struct gn_lesson), with
 * FAULT(figure, step, settings), what it shows and by what, and CURE(step, settings) of all faults.
 * A row, and where there is none yet a scene in assets/make_lessons.c, make a lesson. Included
 * by lesson.c, and for their names by board/host/completion.c. */
/* clang-format off */

/* why shadows matter */
LESSON(.name = "position", .title = "Shadows show where a thing is", .scene = "position",
       .teaches = "Without shadows all three balls seem to lie on the ground, side by side. Their shadows show that two of them float, nearer to the eye.",
       .steps = {FAULT(WRONG, "without shadows", "shadow = none"),
                 CURE("with shadows", "shadow = pcf")})
LESSON(.name = "form", .title = "Shadows show the form of what they fall on", .scene = "form",
       .teaches = "The shadow of a straight pole climbs the steps, follows the wave and bends where the slope begins.",
       .steps = {FAULT(WRONG, "without shadows", "shadow = none"),
                 CURE("with shadows", "shadow = pcf")})
LESSON(.name = "unseen", .title = "Shadows show what is not in the picture", .scene = "unseen",
       .teaches = "A fence and a pawn stand behind the camera. Casters outside of the view belong into the map: it is fitted to what can darken something visible.",
       .steps = {FAULT(WRONG, "without shadows", "shadow = none"),
                 CURE("with shadows", "shadow = pcf")})
LESSON(.name = "lights", .title = "Shadows show how many lights there are, and where", .scene = "lights",
       .teaches = "Three shadows, three lamps: each points away from its lamp and has the colours of the others. The figure is that of the first lamp.",
       .steps = {FAULT(WRONG, "without shadows", "shadow = none"),
                 CURE("with shadows", "shadow = pcf")})

/* the bias */
LESSON(.name = "acne", .title = "Acne: a surface in its own shadow", .scene = "solids", .set = "map = 512\nshadow = hard",
       .teaches = "A texel of the map has one distance for a square of the surface, of which half lies farther from the light: it shades itself, in stripes. The cure is to compare a place that lies off the surface by as much as a texel can be wrong, which depends on the slope and on the size of the texel. A number that is the same for all scenes is right for none.",
       .steps = {FAULT(DARKENING, "without a bias", "bias = 0"),
                 FAULT(DARKENING, "too small a bias", "bias = 0.2"),
                 CURE("automatic bias", NULL)})
LESSON(.name = "peter-panning", .title = "Too large a bias: shadows leave their casters", .scene = "thin", .set = "map = 512\nshadow = hard",
       .teaches = "A bias larger than a thing is thick lets light through its foot, and the thing seems to float (peter-panning). The thinnest things lose their shadows altogether. A bias of no more texels than acne needs, and smaller texels, cure it.",
       .steps = {FAULT(GAP, "16 texels of bias", "bias = 16"),
                 FAULT(GAP, "8 texels of bias", "bias = 8"),
                 CURE("automatic bias", NULL)})
LESSON(.name = "leak", .title = "Light leaks into corners", .scene = "hut", .set = "shadow = hard",
       .teaches = "The same inside a hut: along the foot of its walls and below its roof the bias reaches through the wall, and a line of light appears in the corner. With texels smaller than the wall is thick, and a bias in texels, it is dark.",
       .steps = {FAULT(WRONG, "10 texels of bias, map 256", "map = 256\nbias = 10"),
                 CURE("automatic bias, map 256", "map = 256"),
                 CURE("automatic bias, map 1024", "map = 1024")})
LESSON(.name = "clear", .title = "A map cleared to the wrong end", .scene = "solids", .set = "map = 512\nshadow = hard",
       .teaches = "Where no caster is drawn a map keeps what it was cleared to. Black, to which textures are cleared by habit, is a distance of 0: something right before the light, in whose shadow all lies that the map covers. Cleared to the far end of the light it is lit; and so is what lies beside the map.",
       .steps = {FAULT(DARKENING, "cleared to the near end, 0", "map_format = r32ui\nmap_clear = near"),
                 CURE("cleared to the far end", "map_format = r32ui")})
LESSON(.name = "half-float", .title = "Steps of half-floats", .scene = "far", .set = "map = 1024\nshadow = hard",
       .teaches = "A half-float has 11 bits. Metres from a lamp 150 m away are stored in steps of 12 cm, and a bias that covers a step pulls shadows off their feet. The same 16 bits for the distance from the middle of what the map shows, over half its depth, have steps of millimetres; 32 bits have none that matter.",
       .steps = {FAULT(GAP, "metres in half-floats", "map_format = r16f-raw"),
                 CURE("centred half-floats", "map_format = r16f"),
                 CURE("32 bits", "map_format = r32ui")})
LESSON(.name = "front-faces", .title = "Front-face culling is no cure", .scene = "sheets", .set = "map = 512\nshadow = hard",
       .teaches = "A map of the faces that turn away from the light needs no bias on lit faces. But an open sheet that faces the light is then in no map and casts no shadow: a floor, a leaf, a roof without a thickness. Where both sides cast, an automatic bias cures acne.",
       .steps = {FAULT(DARKENING, "both sides, no bias", "cast_faces = both\nbias = 0"),
                 FAULT(LEAK, "front faces culled, no bias", "cast_faces = back\nbias = 0"),
                 CURE("both sides, automatic bias", "cast_faces = both")})
LESSON(.name = "second-depth", .title = "Second depth and midpoint maps", .scene = "thin", .set = "map = 384\nshadow = hard",
       .teaches = "Of a closed thing a map may hold the far sides (second depth): lit faces then need no bias. But a shadow begins right at a far side, so the least bias opens a gap at its foot. The middle between near and far sides (midpoint) has half the thickness to both. An automatic bias of the near sides cures as much, and of open things, too.",
       .steps = {FAULT(DARKENING, "first depth, no bias", "cast_faces = both\nbias = 0"),
                 FAULT(GAP, "second depth, 1 texel of bias", "cast_faces = back\nbias = 1"),
                 CURE("midpoint, 1 texel of bias", "cast_faces = middle\nbias = 1"),
                 CURE("first depth, automatic bias", "cast_faces = both")})

/* filters */
LESSON(.name = "pcf", .title = "Percentage closer filtering: wider filters, softer edges", .scene = "lattice", .set = "map = 256",
       .teaches = "One comparison for each pixel shows the texels of the map as steps. Filters compare first and average then: the mean of distances would be the distance of nothing. The wider the filter, the nearer its edge comes to the penumbra of this lattice, which has the same width everywhere; a filter wider than the penumbra is wrong again.",
       .steps = {FAULT(PENUMBRA, "one comparison (hard)", "shadow = hard"),
                 FAULT(PENUMBRA, "too wide: a disk of 8 texels", "shadow = disk\nfilter_radius = 8"),
                 CURE("2x2 texels (pcf2)", "shadow = pcf2"),
                 CURE("3x3 texels (pcf)", "shadow = pcf"),
                 CURE("3x3 with equal weights (box3)", "shadow = box3"),
                 CURE("1 2 1, squared (pcf3)", "shadow = pcf3"),
                 CURE("1 3 4 3 1, squared (pcf5)", "shadow = pcf5"),
                 CURE("a disk of 3 texels", "shadow = disk\nfilter_radius = 3")})
LESSON(.name = "soft", .title = "Penumbrae grow with the distance from the caster", .scene = "lean",
       .teaches = "A lamp with a size gives a shadow that is sharp at the foot of its caster and soft far from it. A filter of one width is wrong at one of them. Soft techniques first find how far away the caster is and then filter as wide as its penumbra.",
       .steps = {FAULT(PENUMBRA, "one width (pcf5)", "shadow = pcf5"),
                 CURE("searches blockers (pcss)", "shadow = pcss"),
                 CURE("reads the nearest cone (cone)", "shadow = cone"),
                 CURE("sums of two moments (vssm)", "shadow = vssm")})
LESSON(.name = "light-bleeding", .title = "Two moments let light through, four do not", .scene = "plates", .set = "map = 256",
       .teaches = "Chebyshev's inequality knows the mean and the variance of distances only. Where the edge of the upper plate crosses the shadow of the lower one the variance is large, and light comes through the lower plate. Four moments separate three distances.",
       .steps = {FAULT(GLOW, "two moments (vsm)", "shadow = vsm"),
                 CURE("exponents of the distance (evsm)", "shadow = evsm"),
                 CURE("four moments (msm)", "shadow = msm")})
