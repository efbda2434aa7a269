/* Files that belong to the command: beside it or, once installed, in ../lib/relume. */
#pragma once

#include <stddef.h>

/**
 * Find one of the command's own files.
 * @param name       without folder
 * @param out, size  receive its path
 * @return 0 or ERR_SYSTEM (reported, with the places searched)
 */
int beside_find(const char *name, char *out, size_t size);
