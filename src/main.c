#include <stdio.h>

#include "config.h"

int main(void) {
    puts("gnomon " GN_VERSION);
    return 0;
}
