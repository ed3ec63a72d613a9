/* tool_fidelity JSON: draws one scenario of Khronos' glTF-Render-Fidelity, as its generator asks a
 * program to: the last argument is {"scenario": .., "outputFile": ..} (README.md). Runs gnomon, or
 * what GNOMON names, in its own place; --print prints the command instead. Exit status 2: the
 * argument is wrong. */
#include <errno.h>
#include <jansson.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WORDS_MAX = 48, PIXEL_RATIO = 2 /* the other programs draw for such a screen */ };

struct command {
    const char *words[WORDS_MAX];
    int count;
};

static void add(struct command *c, const char *word) { c->words[c->count++] = word; }

__attribute__((format(printf, 2, 3))) static void add_value(struct command *c, const char *format,
                                                            ...) {
    char *text = NULL;
    va_list args;
    va_start(args, format);
    if (vasprintf(&text, format, args) < 0) abort();
    va_end(args);
    add(c, text);
}

static void add_all(struct command *c, const char *const words[]) {
    while (*words) add(c, *words++);
}

static void fail(const char *what) {
    fprintf(stderr, "tool_fidelity: %s\n", what);
    exit(2);
}

static const json_t *object_of(const json_t *in, const char *name) {
    const json_t *found = json_object_get(in, name);
    if (json_is_object(found)) return found;
    fprintf(stderr, "tool_fidelity: \"%s\" is not an object\n", name);
    exit(2);
}

static double number_of(const json_t *in, const char *name) {
    const json_t *found = json_object_get(in, name);
    if (json_is_number(found)) return json_number_value(found);
    fprintf(stderr, "tool_fidelity: \"%s\" is not a number\n", name);
    exit(2);
}

static const char *string_of(const json_t *in, const char *name) {
    const char *found = json_string_value(json_object_get(in, name));
    if (found && *found) return found;
    fprintf(stderr, "tool_fidelity: \"%s\" is not a text\n", name);
    exit(2);
}

/* Paths are relative to test/renderers/NAME, the program runs three folders above. */
static const char *path_of(const json_t *in, const char *name) {
    const char *path = string_of(in, name);
    for (int i = 0; i < 3 && strncmp(path, "../", 3) == 0; i++) path += 3;
    return path;
}

static void build(struct command *c, const json_t *json) {
    const json_t *scenario = object_of(json, "scenario"), *size = object_of(scenario, "dimensions"),
                 *orbit = object_of(scenario, "orbit"), *target = object_of(scenario, "target");
    const double radius = number_of(orbit, "radius"), width = number_of(size, "width"),
                 height = number_of(size, "height");
    const bool skybox = json_is_true(json_object_get(scenario, "renderSkybox"));
    const char *gnomon = getenv("GNOMON");
    if (!(width >= 1 && width <= 8192 && height >= 1 && height <= 8192))
        fail("\"dimensions\" are not 1 to 8192");
    add(c, gnomon && *gnomon ? gnomon : "gnomon");
    add_all(c, (const char *const[]){"render", path_of(scenario, "model"), "-o",
                                     string_of(json, "outputFile"), "--size", NULL});
    add_value(c, "%.0fx%.0f", PIXEL_RATIO * width, PIXEL_RATIO * height);
    add_all(c, (const char *const[]){"--environment", path_of(scenario, "lighting"),
                                     "--environment-show", skybox ? "yes" : "no", NULL});
    if (!skybox) add_all(c, (const char *const[]){"--background", "transparent", NULL});
    add_all(c, (const char *const[]){"--tone", "aces", "--exposure", "0", "--floor", "none",
                                     "--no-animation", "--msaa", "4", "--camera-theta", NULL});
    add_value(c, "%.9g", number_of(orbit, "theta"));
    add(c, "--camera-phi");
    add_value(c, "%.9g", number_of(orbit, "phi"));
    add(c, "--camera-distance");
    add_value(c, "%.9g", radius > 0 ? radius : 1e-4); /* 0: at the target */
    add(c, "--camera-target");
    add_value(c, "%.9g,%.9g,%.9g", number_of(target, "x"), number_of(target, "y"),
              number_of(target, "z"));
    add(c, "--camera-fov");
    add_value(c, "%.9g", number_of(scenario, "verticalFoV"));
}

int main(int argc, char **argv) {
    const bool print = argc > 2 && strcmp(argv[1], "--print") == 0;
    struct command command = {0};
    json_error_t error;
    if (argc < 2) fail("no scenario; see tests/fidelity/README.md");
    json_t *json = json_loads(argv[argc - 1], 0, &error);
    if (!json) fail(error.text);
    build(&command, json);
    for (int i = 0; print && i < command.count; i++)
        printf("%s%c", command.words[i], i + 1 < command.count ? ' ' : '\n');
    if (print) return 0;
    execvp(command.words[0], (char *const *)command.words);
    fprintf(stderr, "tool_fidelity: %s: %s; GNOMON names the program\n", command.words[0],
            strerror(errno));
    return 1;
}
