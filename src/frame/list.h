#ifndef GN_FRAME_LIST_H
#define GN_FRAME_LIST_H

#include <stddef.h>
#include <stdint.h>

/* A growing array: keeps its memory, allocates only while growing. */
#define GN_LIST(type)                                                                              \
    struct {                                                                                       \
        type *at;                                                                                  \
        uint32_t count, room;                                                                      \
    }
void *gn_list_grow(void *at, uint32_t count, uint32_t *room, size_t size);
/* Room for one more; an lvalue. */
#define GN_LIST_PUSH(list)                                                                         \
    (*((list)->at = gn_list_grow((list)->at, (list)->count, &(list)->room, sizeof *(list)->at),    \
       &(list)->at[(list)->count++]))

#endif
