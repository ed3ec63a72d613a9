/* Small scenes, made in memory, that between them need every kind of program. */
#ifndef GN_TESTS_GPUS_SCENES_H
#define GN_TESTS_GPUS_SCENES_H

#include "scene/scene.h"

enum gn_gpu_scene {
    GN_GPU_SUN, /* a ground of one textured, shining material and a card of it above; one light */
    GN_GPU_POINT,
    GN_GPU_SPOT,
    GN_GPU_SLIDE,         /* a spot with a slide */
    GN_GPU_FILM,          /* the same, lit beside it */
    GN_GPU_FEW_MATERIALS, /* cards that between them have every feature of a material; a sun */
    GN_GPU_MATERIALS,     /* a card of every kind of material; a sun */
    GN_GPU_LAMPS,         /* a sun, a spot and a point light */
    GN_GPU_LOOK,  /* metal and roughness in a texture, also with a normal map, on an unseen floor; a
                     sun */
    GN_GPU_POSED, /* cards with a skin of up to four and up to eight joints, with targets, and with
                     both; a clip moves the skins; a sun */
    GN_GPU_CROWD, /* ten lights, so that some come in passes that add */
    GN_GPU_SCENE_COUNT,
};
/* Never NULL: a scene that does not load is a mistake of ours, and ends the program. */
struct gn_scene *gn_gpu_scene_make(enum gn_gpu_scene scene);

#endif
