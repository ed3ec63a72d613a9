#include "options/topic.h"

#include <string.h>

const struct gn_topic gn_topics[] = {
    {"board", "a kiosk on a board: hardware, permissions, wiring, start, supervision",
     "board/README.md"},
    {"exhibit", "from a .glb to a screen on the wall with two buttons", "board/wall.md"},
    {"use", "commands, keys, buttons, and what to do when something is wrong", "board/use.md"},
    {"scenes", "making scenes: export, lights, cameras, materials, what it costs", "SCENES.md"},
    {"techniques", "techniques of shadows: which to take, what each costs, how wrong it is",
     "src/shadow/README.md"},
    {"report", "what doctor --report writes, and where to send it", "board/report.md"},
    {0},
};

int gn_topic_find(const char *name) {
    for (int i = 0; gn_topics[i].name; i++)
        if (strcmp(gn_topics[i].name, name) == 0) return i;
    return -1;
}
