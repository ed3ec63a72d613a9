/* `gnomon help TOPIC`. */
#ifndef GN_CLI_TOPIC_H
#define GN_CLI_TOPIC_H

/* Prints a page of gn_topics, by its number; on a terminal by $PAGER, else less. */
void gn_topic_print(int topic);

#endif
