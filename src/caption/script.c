#include "caption/script.h"

#include <stddef.h>

#define NOTO(first, last, name, file)                                                              \
    { first, last, name, "NotoSans" file "-Regular.ttf", "fonts-noto-core" }
#define CJK(first, last, name)                                                                     \
    { first, last, name, "NotoSansCJK-Regular.ttc", "fonts-noto-cjk" }

const struct gn_script gn_scripts[] = {
    NOTO(0x0370, 0x03ff, "Greek", ""),
    NOTO(0x0400, 0x052f, "Cyrillic", ""),
    NOTO(0x0530, 0x058f, "Armenian", "Armenian"),
    NOTO(0x0590, 0x05ff, "Hebrew", "Hebrew"),
    NOTO(0xfb1d, 0xfb4f, "Hebrew", "Hebrew"),
    NOTO(0x0600, 0x06ff, "Arabic", "Arabic"),
    NOTO(0x0750, 0x077f, "Arabic", "Arabic"),
    NOTO(0x08a0, 0x08ff, "Arabic", "Arabic"),
    NOTO(0xfb50, 0xfdff, "Arabic", "Arabic"),
    NOTO(0xfe70, 0xfeff, "Arabic", "Arabic"),
    NOTO(0x0900, 0x097f, "Devanagari", "Devanagari"),
    NOTO(0x0980, 0x09ff, "Bengali", "Bengali"),
    NOTO(0x0a00, 0x0a7f, "Gurmukhi", "Gurmukhi"),
    NOTO(0x0a80, 0x0aff, "Gujarati", "Gujarati"),
    NOTO(0x0b00, 0x0b7f, "Oriya", "Oriya"),
    NOTO(0x0b80, 0x0bff, "Tamil", "Tamil"),
    NOTO(0x0c00, 0x0c7f, "Telugu", "Telugu"),
    NOTO(0x0c80, 0x0cff, "Kannada", "Kannada"),
    NOTO(0x0d00, 0x0d7f, "Malayalam", "Malayalam"),
    NOTO(0x0d80, 0x0dff, "Sinhala", "Sinhala"),
    NOTO(0x0e00, 0x0e7f, "Thai", "Thai"),
    NOTO(0x0e80, 0x0eff, "Lao", "Lao"),
    NOTO(0x1000, 0x109f, "Burmese", "Myanmar"),
    NOTO(0x10a0, 0x10ff, "Georgian", "Georgian"),
    NOTO(0x1200, 0x139f, "Ethiopic", "Ethiopic"),
    NOTO(0x1780, 0x17ff, "Khmer", "Khmer"),
    CJK(0x1100, 0x11ff, "Korean"),
    CJK(0x3130, 0x318f, "Korean"),
    CJK(0xac00, 0xd7ff, "Korean"),
    CJK(0x2e80, 0x303f, "Chinese and Japanese"),
    CJK(0x3040, 0x30ff, "Japanese"),
    CJK(0x3100, 0x312f, "Chinese and Japanese"),
    CJK(0x31a0, 0x9fff, "Chinese and Japanese"),
    CJK(0xf900, 0xfaff, "Chinese and Japanese"),
    CJK(0xfe30, 0xfe4f, "Chinese and Japanese"),
    CJK(0xff00, 0xffef, "Chinese and Japanese"),
    CJK(0x20000, 0x3ffff, "Chinese and Japanese"),
    NOTO(0x2190, 0x2bff, "symbol", "Symbols2"),
    NOTO(0x1f000, 0x1faff, "emoji", "Symbols2"),
    {0x2190, 0x2bff, "symbol", "Symbola_hint.ttf", "fonts-symbola"},
    {0x1f000, 0x1faff, "emoji", "Symbola_hint.ttf", "fonts-symbola"},
    {0x00a0, 0x024f, "Latin", "DejaVuSans.ttf", "fonts-dejavu-core"},
    {0x00a0, 0x1ffff, NULL, "DejaVuSans.ttf", "fonts-dejavu-core"},
    NOTO(0x0020, 0x2fff, NULL, ""),
};
const uint32_t gn_script_count = sizeof gn_scripts / sizeof *gn_scripts;

const struct gn_script *gn_script_next(const struct gn_script *row, uint32_t code) {
    for (row = row ? row + 1 : gn_scripts; row < gn_scripts + gn_script_count; row++)
        if (code >= row->first && code <= row->last) return row;
    return NULL;
}

/* ---- properties of characters ---- */

struct range {
    uint32_t first, last;
};

static bool is_in(uint32_t code, const struct range *ranges, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (code >= ranges[i].first && code <= ranges[i].last) return true;
    return false;
}
#define IS_IN(code, ranges) is_in(code, ranges, sizeof(ranges) / sizeof *(ranges))

bool gn_script_is_complex(uint32_t code) {
    static const struct range ranges[] = {{0x0300, 0x036f},   {0x0590, 0x109f},  {0x1100, 0x11ff},
                                          {0x1780, 0x18af},   {0x1a20, 0x1cff},  {0x1dc0, 0x1dff},
                                          {0x200c, 0x200d},   {0x20d0, 0x20ff},  {0xa800, 0xa8ff},
                                          {0xa980, 0xaaff},   {0xabc0, 0xabff},  {0xfb1d, 0xfdff},
                                          {0xfe20, 0xfe2f},   {0xfe70, 0xfeff},  {0x10800, 0x10fff},
                                          {0x11000, 0x11fff}, {0x1e800, 0x1eeff}};
    return IS_IN(code, ranges);
}

bool gn_script_is_rtl(uint32_t code) {
    static const struct range ranges[] = {{0x0590, 0x08ff},
                                          {0xfb1d, 0xfdff},
                                          {0xfe70, 0xfeff},
                                          {0x10800, 0x10fff},
                                          {0x1e800, 0x1efff}};
    return IS_IN(code, ranges);
}

bool gn_script_is_mark(uint32_t code) {
    static const struct range ranges[] = {
        {0x0300, 0x036f}, {0x0483, 0x0489}, {0x0591, 0x05c7}, {0x0610, 0x061a}, {0x064b, 0x065f},
        {0x0670, 0x0670}, {0x06d6, 0x06dc}, {0x06df, 0x06e8}, {0x0900, 0x0903}, {0x093a, 0x094f},
        {0x0951, 0x0957}, {0x0962, 0x0963}, {0x0981, 0x0983}, {0x09bc, 0x09d7}, {0x0a01, 0x0a03},
        {0x0a3c, 0x0a51}, {0x0a81, 0x0a83}, {0x0abc, 0x0acd}, {0x0b01, 0x0b03}, {0x0b3c, 0x0b57},
        {0x0b82, 0x0b82}, {0x0bbe, 0x0bcd}, {0x0c00, 0x0c04}, {0x0c3e, 0x0c56}, {0x0c81, 0x0c83},
        {0x0cbc, 0x0cd6}, {0x0d00, 0x0d03}, {0x0d3b, 0x0d4d}, {0x0d81, 0x0d83}, {0x0dca, 0x0ddf},
        {0x0e31, 0x0e31}, {0x0e33, 0x0e3a}, {0x0e45, 0x0e4e}, {0x0eb1, 0x0eb1}, {0x0eb3, 0x0ebc},
        {0x0ec8, 0x0ece}, {0x102b, 0x103e}, {0x17b4, 0x17d3}, {0x1dc0, 0x1dff}, {0x200c, 0x200d},
        {0x20d0, 0x20ff}, {0x3099, 0x309a}, {0xfe20, 0xfe2f}};
    return IS_IN(code, ranges);
}

bool gn_script_breaks(uint32_t code) {
    static const struct range ranges[] = {{0x2e80, 0x2fff}, {0x3040, 0x3098}, {0x309d, 0x312f},
                                          {0x31a0, 0x9fff}, {0xf900, 0xfaff}, {0x20000, 0x3ffff}};
    return IS_IN(code, ranges);
}
