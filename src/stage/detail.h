/* Levels of detail of a scene (scene/level.h), made at once, or by a thread while frames go on,
 * which until then show whole meshes. */
#ifndef GN_STAGE_DETAIL_H
#define GN_STAGE_DETAIL_H

#include "scene/level.h"

/* Of one scene, which must outlive it. */
struct gn_detailer;
struct gn_detailer *gn_detailer_create(const struct gn_scene *scene);
/* Ends the thread first, which takes the time to simplify one mesh; NULL is legal. */
void gn_detailer_destroy(struct gn_detailer *detailer);
/* What there is, or NULL: it has none, or the thread still works, which the first call starts. now:
 * it is made before this returns. */
const struct gn_detail *gn_detailer_take(struct gn_detailer *detailer, bool now);
/* Its thread works; NULL is legal. */
bool gn_detailer_works(const struct gn_detailer *detailer);

#endif
