/* Units of reports from those of the code. */
#ifndef GN_CLI_UNITS_H
#define GN_CLI_UNITS_H

#define GN_DEG(radians) ((double)(radians) * (180.0 / 3.14159265358979323846))
#define GN_MB(bytes)    ((double)(bytes) / (1024.0 * 1024.0))

#endif
