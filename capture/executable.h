/* The file of a program: can a recorder be loaded into it? */
#pragma once

#include <stddef.h>

enum executable_kind {
	EXECUTABLE_OTHER,  /* a script, or an unreadable file */
	EXECUTABLE_NATIVE, /* dynamic, of this command's class */
	EXECUTABLE_32,     /* dynamic, 32 bits, but this command has 64 */
	EXECUTABLE_STATIC  /* no interpreter: nothing is preloaded into it */
};

/** The file that execvp would find. @return 1, or 0 if there is none */
int executable_find(const char *name, char *out, size_t size);

enum executable_kind executable_kind(const char *path);

/**
 * 1 if the file is set-user-ID or set-group-ID: the loader then preloads nothing into it. Old games use this to keep
 * their scores.
 */
int executable_has_rights(const char *path);
