#include "garden.h"

#include "glb.h"
#include "paint.h"

#include <string.h>

static void paint_pictures(struct gn_garden *g) {
    static const char *const names[PICTURES] = {"",        "grain",  "paving", "timber", "bush",
                                                "lattice", "branch", "window", "grass",  "skyline"};
    const int count = g->plan->vista ? PICTURES : GRASS;
    struct gn_image images[PICTURES] = {{0}};
    gn_paint_grain(&images[GRAIN], 256, 0.25f, 11);
    gn_paint_paving(&images[PAVING], 512, 5);
    gn_paint_wood(&images[TIMBER], 128, 3);
    gn_paint_hedge(&images[BUSH], 128, 8);
    gn_paint_lattice(&images[LATTICE], 128, 6, 4);
    gn_paint_branch(&images[BRANCH], 256, 21);
    gn_paint_window(&images[WINDOW], 192, 17);
    if (g->plan->vista) {
        gn_paint_grass(&images[GRASS], 128, 31);
        gn_garden_paint_vista(&images[SKYLINE]);
    }
    for (int i = GRAIN; i < count; i++) {
        enum gn_glb_wrap wrap = i == BRANCH || i == WINDOW ? GN_GLB_CLAMP : GN_GLB_REPEAT;
        g->pictures[i] = gn_glb_texture(g->glb, names[i], &images[i], wrap);
        gn_image_finish(&images[i]);
    }
}

static const struct {
    const char *name;
    float rgba[4], metal, rough, glow;
    enum gn_picture picture;
    enum gn_glb_alpha alpha;
    bool double_sided;
} surfaces[] = {
    [COURT] = {"court", {.90f, .79f, .62f, 1}, 0, 1, 0, PAVING, GN_GLB_OPAQUE, false},
    [LAWN] = {"lawn", {.30f, .46f, .12f, 1}, 0, 1, 0, BUSH, GN_GLB_OPAQUE, false},
    [STONE] = {"stone", {.78f, .72f, .62f, 1}, 0, .9f, 0, GRAIN, GN_GLB_OPAQUE, false},
    [MARBLE] = {"marble", {.93f, .90f, .84f, 1}, 0, .6f, 0, GRAIN, GN_GLB_OPAQUE, false},
    [LIME] = {"limewash", {.95f, .93f, .88f, 1}, 0, 1, 0, GRAIN, GN_GLB_OPAQUE, false},
    [BRONZE] = {"bronze", {.46f, .27f, .10f, 1}, .7f, .38f, 0, NO_PICTURE, GN_GLB_OPAQUE, false},
    [INLAY] = {"inlay", {.10f, .06f, .03f, 1}, .3f, .5f, 0, NO_PICTURE, GN_GLB_OPAQUE, false},
    [WOOD] = {"wood", {.42f, .24f, .11f, 1}, 0, .8f, 0, TIMBER, GN_GLB_OPAQUE, false},
    [BARK] = {"bark", {.24f, .16f, .10f, 1}, 0, 1, 0, TIMBER, GN_GLB_OPAQUE, false},
    [HEDGE] = {"hedge", {.16f, .30f, .07f, 1}, 0, 1, 0, BUSH, GN_GLB_OPAQUE, false},
    [SCREEN] = {"lattice", {.62f, .40f, .22f, 1}, 0, .9f, 0, LATTICE, GN_GLB_MASK, true},
    [LEAVES] = {"leaves", {.55f, .75f, .40f, 1}, 0, .9f, 0, BRANCH, GN_GLB_MASK, true},
    [IRON] = {"iron", {.05f, .06f, .06f, 1}, .2f, .5f, 0, NO_PICTURE, GN_GLB_OPAQUE, false},
    [GLASS] = {"glass", {.10f, .42f, .50f, .42f}, 0, .12f, 0, NO_PICTURE, GN_GLB_BLEND, false},
    [PANE] = {"pane", {.95f, .70f, .40f, .35f}, 0, .3f, .15f, NO_PICTURE, GN_GLB_BLEND, false},
    [GLOW] = {"flame", {1, .7f, .4f, 1}, 0, 1, 1, NO_PICTURE, GN_GLB_OPAQUE, false},
    [GULL] = {"gull", {.92f, .93f, .95f, 1}, 0, .8f, 0, NO_PICTURE, GN_GLB_OPAQUE, true},
    [VISTA] = {"landscape", {1, 1, 1, 1}, 0, 1, 0, SKYLINE, GN_GLB_OPAQUE, false},
};

static struct gn_tint tint_of(const struct gn_garden_plan *plan, enum gn_surface surface) {
    struct gn_tint tint = {
        surface, {0}, surfaces[surface].metal, surfaces[surface].rough, surfaces[surface].picture};
    memcpy(tint.rgba, surfaces[surface].rgba, sizeof tint.rgba);
    for (int i = 0; plan->tints[i].rough > 0; i++)
        if (plan->tints[i].surface == surface) tint = plan->tints[i];
    return tint;
}

static void mix_materials(struct gn_garden *g) {
    for (int i = 0; i < (g->plan->vista ? SURFACES : VISTA); i++) {
        const struct gn_tint tint = tint_of(g->plan, (enum gn_surface)i);
        struct gn_glb_material m = {.name = surfaces[i].name,
                                    .metal = tint.metal,
                                    .rough = tint.rough,
                                    .texture = g->pictures[tint.picture],
                                    .alpha = surfaces[i].alpha,
                                    .double_sided = surfaces[i].double_sided};
        memcpy(m.rgba, tint.rgba, sizeof m.rgba);
        for (int c = 0; c < 3; c++) m.emissive[c] = surfaces[i].glow * m.rgba[c];
        g->surfaces[i] = gn_glb_material(g->glb, &m);
    }
}

void gn_garden_init(struct gn_garden *g, struct gn_glb *glb, const struct gn_garden_plan *plan) {
    *g = (struct gn_garden){.glb = glb, .plan = plan};
    paint_pictures(g);
    mix_materials(g);
}

static float uv_scale(enum gn_surface surface) {
    switch (surfaces[surface].picture) {
    case GRAIN: return 0.55f;
    case TIMBER: return 1.4f;
    case BUSH: return surface == LAWN ? 0.4f : 1.1f;
    case NO_PICTURE: return 0;
    default: return 1;
    }
}

struct gn_shape gn_garden_begin(enum gn_surface surface) {
    struct gn_shape shape;
    gn_shape_init(&shape, uv_scale(surface));
    return shape;
}

int gn_garden_mesh(struct gn_garden *g, const char *name, struct gn_shape *shape,
                   enum gn_surface surface) {
    int mesh = gn_glb_mesh(g->glb, name, gn_glb_geometry(g->glb, shape), g->surfaces[surface]);
    gn_shape_finish(shape);
    return mesh;
}

int gn_garden_stand(struct gn_garden *g, const char *name, int mesh, struct gn_place at,
                    const char *extras) {
    struct gn_glb_node node = {
        .name = name, .mesh = mesh, .move = {at.x, at.y, at.z}, .extras = extras};
    if (at.yaw != 0) gn_glb_turn_y(at.yaw, node.turn);
    return gn_glb_node(g->glb, &node);
}

void gn_garden_put(struct gn_garden *g, const char *name, struct gn_shape *shape,
                   enum gn_surface surface) {
    gn_garden_stand(g, name, gn_garden_mesh(g, name, shape, surface), (struct gn_place){0}, NULL);
}
