/* The file of a program: can a recorder be loaded into it? */
#pragma once

#include <stddef.h>

enum executable_kind {
	EXECUTABLE_OTHER,  /* a script, or what cannot be read */
	EXECUTABLE_NATIVE, /* dynamic, of this command's class */
	EXECUTABLE_32,     /* dynamic, of 32 bits, where this command has 64 */
	EXECUTABLE_STATIC  /* no interpreter: nothing is preloaded into it */
};

/** The file that execvp would find. @return 1, or 0 where there is none */
int executable_find(const char *name, char *out, size_t size);

enum executable_kind executable_kind(const char *path);

/**
 * 1 where the file brings rights of its own (set-user-ID, set-group-ID): the loader preloads nothing into it. Old games do, for
 * their scores.
 */
int executable_has_rights(const char *path);
