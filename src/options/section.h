/* The table of the sections of the configuration file: a row makes a section, in the file, in
 * messages, --check, --help and the manual, in this order. Of a section of many, [button "NAME"],
 * there may be GN_SECTIONS_MAX, each with a name of its own. */
#ifndef GN_OPTIONS_SECTION_H
#define GN_OPTIONS_SECTION_H

#include "options/options.h"

enum { GN_SECTIONS_MAX = 32 }; /* of one kind */

struct gn_sections { /* those of many, of one kind, in the order of the file */
    struct gn_named_section *items;
    int count;
};
struct gn_section_row {
    const char *title;   /* "render"; `mode "NAME"`: one of many */
    const char *about;   /* sentences of the manual */
    const char *heading; /* of its options in --help; NULL: it has none */
    int place;           /* of that among the others, from 1 */
    bool of_content;     /* of a kiosk.ini that gnomon take brings, not of the file below it */
    bool of_machine;     /* never of that one, but for what content.c excepts */
    bool of_modes;       /* its keys are modes', too */
    bool by_whole_names; /* whole names of its options are keys, too: light_azimuth for azimuth */
    bool takes_whole_names; /* those of all sections with by_whole_names are its keys */
    /* of many */
    const struct gn_option_row *rows; /* its own keys, for gn_section_fill(); NULL: of options */
    int row_count;
    bool (*has)(const struct gn_option_row *row); /* of options: which */
    bool one_word;                                /* a name has no spaces */
    /* Puts them into the options, after those of the rows above. Not checks: the file has other
     * errors, from which all may follow. False: no memory, or what the whole file shows is wrong.
     */
    bool (*take)(struct gn_options *options, const struct gn_sections *sections, bool checks,
                 struct gn_err *err);
};
enum { GN_SECTION_COUNT = 11 };
extern const struct gn_section_row gn_section_rows[GN_SECTION_COUNT];

bool gn_section_is_many(const struct gn_section_row *section);
/* By the word of its title, "mode"; NULL: none. */
const struct gn_section_row *gn_section_find(const char *word, bool many);
void gn_section_list(char *out, size_t size); /* "[display], .. or [button "NAME"]" */

/* The rows of which some are its keys, and how many. */
const struct gn_option_row *gn_section_options(const struct gn_section_row *section, int *count);
/* The key of a row there, "max_fps": its own, else its option's whole name; NULL: it has none. */
const char *gn_section_key(const struct gn_section_row *section, const struct gn_option_row *row,
                           char *buffer, size_t size);
/* The row of a key; NULL: none. */
const struct gn_option_row *gn_section_find_key(const struct gn_section_row *section,
                                                const char *key);

#endif
