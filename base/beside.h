/* Files that belong to the command: they lie beside it, or in ../lib/relume where it is installed. */
#ifndef BASE_BESIDE_H
#define BASE_BESIDE_H

#include <stddef.h>

/**
 * Find one of the command's own files.
 * @param name       without folder
 * @param out, size  receive its path
 * @return 0 or ERR_SYSTEM (reported: where it was looked for)
 */
int beside_find(const char *name, char *out, size_t size);

#endif
