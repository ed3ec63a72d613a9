/* Removing a test's temporary folder. */
#ifndef GN_TEST_FOLDER_H
#define GN_TEST_FOLDER_H

#include <stdio.h>
#include <stdlib.h>

/* With all that is in it. 0, or the status of what failed, for cmocka's tear-downs to return. */
static inline int gn_test_remove_folder(const char *folder) {
    char command[160];
    snprintf(command, sizeof command, "/bin/rm -rf '%s'", folder);
    return system(command);
}

#endif
