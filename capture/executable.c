#include "capture/executable.h"

#include <elf.h>
#include <fcntl.h>
#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

int executable_find(const char *name, char *out, size_t size)
{
	const char *end, *dir = strchr(name, '/') ? "" : getenv("PATH");
	struct stat st;

	for (; dir; dir = *end ? end + 1 : NULL) {
		end = strchrnul(dir, ':');
		snprintf(out, size, "%.*s%s%s", (int)(end - dir), dir, end > dir ? "/" : "", name);
		if (access(out, X_OK) == 0 && stat(out, &st) == 0 && S_ISREG(st.st_mode))
			return 1;
	}
	return 0;
}

int executable_has_rights(const char *path)
{
	struct stat st;

	return stat(path, &st) == 0 && (st.st_mode & (S_ISUID | S_ISGID)) != 0;
}

/* 1 if the segment table names an interpreter, the dynamic loader. */
static int has_interpreter(int fd, int is_64, uint64_t at, unsigned n)
{
	for (unsigned i = 0; i < n; i++) {
		Elf64_Phdr segment; /* p_type comes first in both classes */
		const size_t bytes = is_64 ? sizeof(Elf64_Phdr) : sizeof(Elf32_Phdr);

		if (pread(fd, &segment, bytes, (off_t)(at + i * bytes)) != (ssize_t)bytes)
			return 0;
		if (segment.p_type == PT_INTERP)
			return 1;
	}
	return 0;
}

enum executable_kind executable_kind(const char *path)
{
	union {
		Elf64_Ehdr of_64;
		Elf32_Ehdr of_32;
	} head = { 0 };
	int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK), is_64;
	enum executable_kind kind = EXECUTABLE_OTHER;

	if (fd < 0)
		return kind;
	if (read(fd, &head, sizeof(head)) >= (ssize_t)sizeof(head.of_32) && memcmp(head.of_64.e_ident, ELFMAG, SELFMAG) == 0) {
		is_64 = head.of_64.e_ident[EI_CLASS] == ELFCLASS64;
		if (!has_interpreter(fd, is_64, is_64 ? head.of_64.e_phoff : head.of_32.e_phoff,
		                     is_64 ? head.of_64.e_phnum : head.of_32.e_phnum))
			kind = EXECUTABLE_STATIC;
		else
			kind = is_64 || sizeof(void *) == 4 ? EXECUTABLE_NATIVE : EXECUTABLE_32;
	}
	close(fd);
	return kind;
}
