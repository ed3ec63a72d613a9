/* Pages that `gnomon help TOPIC` prints. They are embedded in the program. */
#ifndef GN_OPTIONS_TOPIC_H
#define GN_OPTIONS_TOPIC_H

struct gn_topic {
    const char *name, *what, *page; /* page: as gn_embedded_find() takes it */
};
extern const struct gn_topic gn_topics[]; /* ends with a NULL name */

/* The number of the topic, from 0; -1: there is none of that name. */
int gn_topic_find(const char *name);

#endif
