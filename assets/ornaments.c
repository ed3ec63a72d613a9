/* Objects around the dial that cast and receive shadows: thick, round, thin, and with holes. */
#include "garden.h"

#include "glb.h"
#include "shape/outline.h"

#include <math.h>
#include <stdio.h>

static int column_mesh(struct gn_garden *g) {
    static const float profile[][2] = {
        {0, .12f},     {.27f, .12f},  {.30f, .15f},  {.30f, .19f},  {.27f, .22f},  {.23f, .24f},
        {.22f, .30f},  {.215f, 1.1f}, {.19f, 2.22f}, {.22f, 2.25f}, {.22f, 2.29f}, {.19f, 2.31f},
        {.20f, 2.38f}, {.27f, 2.45f}, {.29f, 2.49f}, {0, 2.49f},
    };
    struct gn_shape shape = gn_garden_begin(STONE);
    gn_shape_move(&shape, 0, -.05f, 0);
    gn_shape_block(&shape, .72f, .18f, .72f);
    gn_shape_home(&shape);
    gn_shape_lathe(&shape, profile, GN_COUNT(profile), 20);
    gn_shape_move(&shape, 0, 2.48f, 0);
    gn_shape_block(&shape, .64f, .12f, .64f);
    return gn_garden_mesh(g, "column", &shape, STONE);
}

static void add_beam(struct gn_shape *shape, const struct gn_place *a, const struct gn_place *b,
                     float scale) {
    gn_shape_at(shape, (a->x + b->x) / 2, 2.59f * scale, (a->z + b->z) / 2);
    gn_shape_turn(shape, 'y', atan2f(a->z - b->z, b->x - a->x) / GN_RADIANS);
    gn_shape_block(shape, hypotf(b->x - a->x, b->z - a->z) + .1f, .26f * scale, .42f * scale);
}

void gn_garden_add_portico(struct gn_garden *g) {
    struct gn_shape beams = gn_garden_begin(STONE);
    const struct gn_place *places = g->plan->columns;
    const float scale = g->plan->column_scale;
    int column = column_mesh(g);
    for (int i = 0; i < 4; i++) {
        char name[24];
        snprintf(name, sizeof name, "Column %d", i + 1);
        struct gn_glb_node node = {.name = name,
                                   .mesh = column,
                                   .move = {places[i].x, places[i].y, places[i].z},
                                   .scale = {scale, scale, scale}};
        gn_glb_turn_y(places[i].yaw, node.turn);
        gn_glb_node(g->glb, &node);
    }
    for (int i = 0; i < 3; i++) {
        add_beam(&beams, &places[i], &places[i + 1], scale > 0 ? scale : 1);
        gn_shape_home(&beams);
    }
    gn_garden_put(g, "Architrave", &beams, STONE);
}

void gn_garden_add_bench(struct gn_garden *g) {
    struct gn_shape shape = gn_garden_begin(STONE);
    for (int side = -1; side <= 1; side += 2) {
        gn_shape_at(&shape, .72f * (float)side, -.05f, 0);
        gn_shape_block(&shape, .22f, .48f, .42f);
    }
    gn_shape_at(&shape, 0, .42f, 0);
    gn_shape_block(&shape, 2.0f, .11f, .56f);
    gn_garden_stand(g, "Bench", gn_garden_mesh(g, "bench", &shape, STONE), g->plan->bench, NULL);
}

void gn_garden_add_urns(struct gn_garden *g) {
    static const float profile[][2] = {
        {0, .69f},     {.20f, .69f},  {.20f, .73f},   {.10f, .78f},  {.075f, .84f}, {.10f, .90f},
        {.22f, .97f},  {.31f, 1.08f}, {.34f, 1.20f},  {.31f, 1.33f}, {.24f, 1.42f}, {.22f, 1.47f},
        {.27f, 1.53f}, {.34f, 1.56f}, {.34f, 1.585f}, {.28f, 1.58f}, {.19f, 1.50f}, {0, 1.47f},
    };
    struct gn_shape shape = gn_garden_begin(LIME);
    gn_shape_move(&shape, 0, -.05f, 0);
    gn_shape_block(&shape, .74f, .17f, .74f);
    gn_shape_move(&shape, 0, .16f, 0);
    gn_shape_block(&shape, .52f, .54f, .52f);
    gn_shape_move(&shape, 0, .53f, 0);
    gn_shape_block(&shape, .64f, .08f, .64f);
    gn_shape_home(&shape);
    gn_shape_lathe(&shape, profile, GN_COUNT(profile), 28);
    int mesh = gn_garden_mesh(g, "urn", &shape, LIME);
    gn_garden_stand(g, "Urn N", mesh, g->plan->urns[0], NULL);
    gn_garden_stand(g, "Urn E", mesh, g->plan->urns[1], NULL);
}

void gn_garden_add_balls(struct gn_garden *g) {
    static const float balls[][3] = {{2.55f, 2.75f, .36f}, {3.2f, 2.2f, .22f}, {2.2f, 3.4f, .18f}};
    struct gn_shape shape = gn_garden_begin(STONE);
    gn_shape_sphere(&shape, 1, 28, 16);
    int mesh = gn_garden_mesh(g, "ball", &shape, STONE);
    for (int i = 0; i < GN_COUNT(balls); i++) {
        char name[24];
        snprintf(name, sizeof name, "Ball %d", i + 1);
        gn_glb_node(g->glb,
                    &(struct gn_glb_node){.name = name,
                                          .mesh = mesh,
                                          .move = {balls[i][0], balls[i][2] - .004f, balls[i][1]},
                                          .scale = {balls[i][2], balls[i][2], balls[i][2]}});
    }
}

void gn_garden_add_globe(struct gn_garden *g) {
    const struct gn_place at = g->plan->globe;
    struct gn_shape glass = gn_garden_begin(GLASS), foot = gn_garden_begin(BRONZE);
    gn_shape_at(&glass, at.x, .93f, at.z);
    gn_shape_sphere(&glass, .27f, 32, 16);
    gn_garden_stand(g, "Gazing globe", gn_garden_mesh(g, "globe", &glass, GLASS),
                    (struct gn_place){0}, "{\"gnomon_cast\":false}");
    const float profile[][2] = {{0, -.02f},   {.2f, -.02f}, {.2f, .03f},  {.06f, .09f},
                                {.035f, .3f}, {.05f, .55f}, {.12f, .67f}, {0, .665f}};
    gn_shape_at(&foot, at.x, 0, at.z);
    gn_shape_lathe(&foot, profile, GN_COUNT(profile), 20);
    gn_garden_put(g, "Globe stand", &foot, BRONZE);
}

void gn_garden_add_armillary(struct gn_garden *g) {
    static const float profile[][2] = {{0, -.05f},   {.34f, -.05f}, {.34f, .08f}, {.24f, .14f},
                                       {.17f, .24f}, {.15f, .60f},  {.19f, .80f}, {.26f, .86f},
                                       {.26f, .93f}, {0, .95f}};
    struct gn_shape foot = gn_garden_begin(STONE), rings = gn_garden_begin(BRONZE);
    gn_shape_lathe(&foot, profile, GN_COUNT(profile), 24);
    gn_garden_stand(g, "Armillary foot", gn_garden_mesh(g, "armillary foot", &foot, STONE),
                    g->plan->armillary, NULL);
    for (int i = 0; i < 3; i++) {
        gn_shape_at(&rings, 0, 1.5f, 0);
        gn_shape_turn(&rings, 'x',
                      GN_LATITUDE - 90); /* the equatorial ring is normal to the earth's axis */
        if (i > 0) gn_shape_turn(&rings, 'z', 90);
        if (i > 1) gn_shape_turn(&rings, 'x', 90);
        gn_shape_torus(&rings, .46f + .018f * (float)i, .016f, 32, 6);
    }
    const float c = cosf(GN_LATITUDE * GN_RADIANS), s = sinf(GN_LATITUDE * GN_RADIANS);
    gn_shape_home(&rings);
    gn_shape_rod(&rings, (float[3]){0, 1.5f - .62f * s, .62f * c},
                 (float[3]){0, 1.5f + .62f * s, -.62f * c}, .012f, 6);
    gn_shape_rod(&rings, (float[3]){0, .93f, 0}, (float[3]){0, 1.03f, 0}, .03f, 8);
    gn_garden_stand(g, "Armillary", gn_garden_mesh(g, "armillary", &rings, BRONZE),
                    g->plan->armillary, NULL);
}

void gn_garden_add_arches(struct gn_garden *g) {
    struct gn_shape shape = gn_garden_begin(IRON);
    for (int i = 0; i < 3; i++) {
        gn_shape_at(&shape, 0, -.05f, .45f * (float)(i - 1));
        gn_shape_arch(&shape, 1.5f, 1.5f, .022f, 6);
    }
    gn_shape_home(&shape);
    for (int i = 0; i < 9; i++) {
        float angle = (float)M_PI * (float)(i - 1) / 6, x = -.75f * cosf(angle),
              y = 1.45f + .75f * sinf(angle);
        if (i == 0 || i == 8) x = i ? .75f : -.75f, y = .8f;
        gn_shape_rod(&shape, (float[3]){x, y, -.52f}, (float[3]){x, y, .52f}, .014f, 5);
    }
    gn_garden_stand(g, "Rose arch", gn_garden_mesh(g, "arch", &shape, IRON), g->plan->arches, NULL);
}

void gn_garden_add_canes(struct gn_garden *g) {
    struct gn_shape shape = gn_garden_begin(WOOD);
    for (int i = 0; i < 5; i++) {
        float angle = 2 * (float)M_PI * (float)i / 5, c = cosf(angle), s = sinf(angle);
        gn_shape_rod(&shape, (float[3]){.55f * c, -.03f, .55f * s},
                     (float[3]){-.1f * c, 1.95f + .03f * (float)i, -.1f * s}, .014f, 6);
    }
    gn_shape_at(&shape, 0, 1.62f, 0);
    gn_shape_torus(&shape, .045f, .014f, 12, 6);
    gn_garden_stand(g, "Canes", gn_garden_mesh(g, "canes", &shape, WOOD),
                    (struct gn_place){-.6f, 0, -5.6f, 0}, NULL);
}

void gn_garden_add_fence(struct gn_garden *g) {
    struct gn_shape shape = gn_garden_begin(WOOD);
    gn_shape_fence(&shape, &(struct gn_fence){.length = 2.3f,
                                              .height = .82f,
                                              .pitch = .19f,
                                              .pale = .085f,
                                              .depth = .03f,
                                              .pointed = true});
    gn_garden_stand(g, "Fence", gn_garden_mesh(g, "fence", &shape, WOOD),
                    (struct gn_place){-3.6f, -.004f, -4.75f, 12}, NULL);
}

void gn_garden_add_screen(struct gn_garden *g) {
    struct gn_shape frame = gn_garden_begin(WOOD), card = gn_garden_begin(SCREEN);
    for (int side = -1; side <= 1; side += 2) {
        gn_shape_at(&frame, .95f * (float)side, -.05f, 0);
        gn_shape_block(&frame, .09f, 2.0f, .09f);
        gn_shape_at(&frame, 0, side < 0 ? .12f : 1.76f, 0);
        gn_shape_block(&frame, 1.83f, .07f, .06f);
    }
    gn_shape_at(&card, 0, .18f, 0);
    gn_shape_card(&card, 1.84f, 1.6f);
    const struct gn_place at = g->plan->screen;
    gn_garden_stand(g, "Screen frame", gn_garden_mesh(g, "screen frame", &frame, WOOD), at, NULL);
    gn_garden_stand(g, "Screen", gn_garden_mesh(g, "screen", &card, SCREEN), at, NULL);
}

static void leaf_card(struct gn_shape *shape, int i) {
    float turn = 137.5f * (float)i, lift = .5f + .5f * cosf(.9f * (float)i),
          out = .25f + .55f * (1 - lift * .6f);
    gn_shape_at(shape, 0, 2.15f + 1.5f * lift, 0);
    gn_shape_turn(shape, 'y', turn);
    gn_shape_move(shape, 0, 0, .6f * out);
    gn_shape_turn(shape, 'x', 78 - 60 * lift);
    gn_shape_turn(shape, 'y', 40 * sinf(1.7f * (float)i));
    gn_shape_card(shape, 1.25f, 1.25f);
}

void gn_garden_add_trees(struct gn_garden *g) {
    const struct gn_place *places = g->plan->trees;
    static const float bole[][2] = {{0, -.05f},   {.16f, -.05f}, {.11f, .3f},
                                    {.09f, 1.6f}, {.05f, 3.2f},  {0, 3.3f}};
    struct gn_shape trunk = gn_garden_begin(BARK), crown = gn_garden_begin(LEAVES);
    gn_shape_lathe(&trunk, bole, GN_COUNT(bole), 10);
    for (int i = 0; i < 46; i++) leaf_card(&crown, i);
    int trunk_mesh = gn_garden_mesh(g, "trunk", &trunk, BARK),
        crown_mesh = gn_garden_mesh(g, "crown", &crown, LEAVES);
    for (int i = 0; i < GN_COUNT(g->plan->trees); i++) {
        char name[24];
        snprintf(name, sizeof name, "Trunk %d", i + 1);
        gn_garden_stand(g, name, trunk_mesh, places[i], NULL);
        snprintf(name, sizeof name, "Crown %d", i + 1);
        gn_garden_stand(g, name, crown_mesh, places[i], NULL);
    }
}

void gn_garden_add_cypresses(struct gn_garden *g) {
    const float(*places)[3] = g->plan->cypresses;
    static const float profile[][2] = {{0, -.05f},   {.5f, -.05f}, {.62f, .5f}, {.6f, 1.3f},
                                       {.42f, 2.5f}, {.18f, 3.5f}, {0, 3.9f}};
    struct gn_shape shape = gn_garden_begin(HEDGE);
    gn_shape_lathe(&shape, profile, GN_COUNT(profile), 18);
    int mesh = gn_garden_mesh(g, "cypress", &shape, HEDGE);
    for (int i = 0; places[i][2] > 0; i++) {
        char name[24];
        snprintf(name, sizeof name, "Cypress %d", i + 1);
        float s = places[i][2];
        gn_glb_node(g->glb, &(struct gn_glb_node){.name = name,
                                                  .mesh = mesh,
                                                  .move = {places[i][0], 0, places[i][1]},
                                                  .scale = {s, s, s}});
    }
}
