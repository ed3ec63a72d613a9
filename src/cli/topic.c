#include "cli/topic.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "core/embedded.h"
#include "options/topic.h"

void gn_topic_print(int topic) {
    const int not_found = 127 << 8; /* of the shell that starts the pager */
    const struct gn_embedded *page = gn_embedded_find(gn_topics[topic].page);
    const char *pager = getenv("PAGER");
    FILE *to = isatty(STDOUT_FILENO) ? popen(pager && pager[0] ? pager : "less -FRX", "w") : NULL;
    if (to) fwrite(page->data, 1, page->size, to);
    if (!to || pclose(to) == not_found) fwrite(page->data, 1, page->size, stdout);
}
