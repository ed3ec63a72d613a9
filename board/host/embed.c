/* Host tool: embed NAME=FILE.. writes a C file with the files as read-only bytes (by .incbin, which
 * costs no compile time) and the table of src/core/embedded.h. Paths are relative to the top
 * folder.
 */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static void print_bytes(int i, const char *path) {
    printf("__asm__(\".section .rodata\\n.balign 16\\n.globl gn_embedded_%d\\n\"\n", i);
    printf("        \".hidden gn_embedded_%d\\ngn_embedded_%d:\\n\"\n", i, i);
    printf("        \".incbin \\\"%s\\\"\\n.byte 0\\n.text\\n\");\n", path);
    printf("extern const unsigned char gn_embedded_%d[];\n", i);
}

static void print_row(int i, const char *name, const char *path, long size) {
    printf("    {\"%.*s\", gn_embedded_%d, %ld},\n", (int)(path - 1 - name), name, i, size);
}

int main(int argc, char **argv) {
    struct stat info;
    printf("/* Generated. */\n#include \"core/embedded.h\"\n\n");
    for (int i = 1; i < argc; i++) {
        const char *equals = strchr(argv[i], '=');
        if (!equals || strpbrk(argv[i], "\"\\\n") || stat(equals + 1, &info)) {
            fprintf(stderr, "embed: \"%s\" is not NAME=FILE\n", argv[i]);
            return 2;
        }
        print_bytes(i, equals + 1);
    }
    printf("\nconst struct gn_embedded gn_embedded_table[] = {\n");
    for (int i = 1; i < argc; i++) {
        const char *path = strchr(argv[i], '=') + 1;
        if (stat(path, &info)) return 1;
        print_row(i, argv[i], path, (long)info.st_size);
    }
    printf("    {0, 0, 0},\n};\n");
    return ferror(stdout) || fclose(stdout) ? 1 : 0;
}
