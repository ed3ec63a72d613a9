/* What `gnomon take` keeps, laid over the configuration file. */
#ifndef GN_OPTIONS_CONTENT_H
#define GN_OPTIONS_CONTENT_H

#include "options/options.h"

/* After the file, before flags and modes. folder: --content, or NULL: that of the file. A folder
 * with a kiosk.ini: what that sets beats the file, whose [scene], [camera], [light], lights and
 * modes do not hold any more; all else, such as the fade and the buttons, does unless it is set
 * there. What belongs to the machine is always the file's, and a warning names each line that sets
 * it: [display] without rotate and pixel_shift, [schedule], content, socket, state, screenshots,
 * size, without, shaders, and limits above its own. A folder with one scene: that one replaces
 * those of the file's [scene]. Nothing to show: nothing changes. False: the options are unusable.
 */
bool gn_options_lay_content(struct gn_options *options, const char *folder,
                            struct gn_warnings *warnings, struct gn_err *err);

#endif
