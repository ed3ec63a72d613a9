/* Opening files that a model names, confined to the model's folder. */
#ifndef GN_CORE_BENEATH_H
#define GN_CORE_BENEATH_H

/* Opens a file of the folder or below for reading, without blocking on a FIFO or a device. Links
 * are followed as long as the file that they lead to lies in the folder; the file that is opened is
 * the one that was checked, so that it cannot be exchanged in between. Where
 * there is no such file, one is taken whose path differs in the case of ASCII letters, if it is the
 * only one. Returns a descriptor, or a negative errno: -EXDEV if it lies outside or that cannot be
 * known. */
int gn_open_beneath(const char *folder, const char *name);

#endif
