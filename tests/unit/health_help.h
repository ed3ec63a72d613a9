/* A board's files of /sys and /proc below a folder. */
#ifndef GN_UNIT_HEALTH_HELP_H
#define GN_UNIT_HEALTH_HELP_H

/* A path below the root, with its folders. */
void health_write(const char *root, const char *path, const char *text);
/* A Raspberry Pi 4 on which all is well. */
void health_pi4(const char *root);
void health_remove(const char *root, const char *path); /* a file, or a folder with all in it */

#endif
