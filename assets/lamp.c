#include "lamp.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define RADIANS (float)(M_PI / 180)

void gn_lamp_add(struct gn_glb *glb, const struct gn_lamp *lamp) {
    const char *name = lamp->name ? lamp->name : "light", *keys = lamp->keys ? lamp->keys : "";
    char extras[400], radius[40] = "";
    if (lamp->radius > 0)
        snprintf(radius, sizeof radius, "\"gnomon_radius\":%g", (double)lamp->radius);
    snprintf(extras, sizeof extras, "{%s%s%s}", radius, *radius && *keys ? "," : "", keys);
    struct gn_glb_light light = {.name = name,
                                 .kind = lamp->kind,
                                 .rgb = {lamp->rgb[0], lamp->rgb[1], lamp->rgb[2]},
                                 .intensity = lamp->intensity,
                                 .range = lamp->range,
                                 .extras = *radius || *keys ? extras : NULL};
    if (lamp->kind == GN_GLB_SPOT) {
        light.outer = lamp->cone_deg * RADIANS;
        light.inner = .9f * light.outer;
    }
    struct gn_glb_node node = {.name = name, .light = gn_glb_light(glb, &light)};
    memcpy(node.move, lamp->at, sizeof node.move);
    gn_glb_look(lamp->at, lamp->aim, node.turn);
    gn_glb_node(glb, &node);
}

void gn_view_add(struct gn_glb *glb, const struct gn_view *view) {
    const char *name = view->name ? view->name : "camera";
    const struct gn_glb_camera lens = {.name = name,
                                       .aspect = view->aspect > 0 ? view->aspect : 16.0f / 9,
                                       .yfov = view->yfov_deg * RADIANS,
                                       .znear = view->znear > 0 ? view->znear : .1f,
                                       .zfar = view->zfar > 0 ? view->zfar : 200};
    struct gn_glb_node node = {.name = name, .camera = gn_glb_camera(glb, &lens)};
    memcpy(node.move, view->eye, sizeof node.move);
    gn_glb_look(view->eye, view->aim, node.turn);
    gn_glb_node(glb, &node);
}
