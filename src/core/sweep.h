/* Temporary files that a killed process has left. */
#ifndef GN_CORE_SWEEP_H
#define GN_CORE_SWEEP_H

#include <stdbool.h>
#include <stddef.h>

/* The name of this process's temporary file of that number in a folder, which is "" or ends with
 * '/'. False if it does not fit. Its writer holds flock() on it. */
bool gn_sweep_name(char *name, size_t size, const char *folder, int number);

/* Removes the temporary files in the folder that are this user's, older than a minute and held by
 * nobody. Does that once for a folder, not for each of many files that are written into it. */
void gn_sweep_folder(const char *folder);

#endif
