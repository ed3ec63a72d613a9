/* Host tool: prints the man page. */
#include "cli/help.h"
#include "config.h"

int main(void) {
    gn_help_print_man(stdout, GN_VERSION);
    return ferror(stdout) || fclose(stdout) ? 1 : 0;
}
