#include "base/kept.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "base/folder.h"
#include "base/part.h"

static const char magic[8] = { 'r', 'e', 'l', 'u', 'm', 'e', 2, '\n' }; /* the line end reveals files transferred as
                                                                           text */

struct header {
	char magic[8];
	uint64_t key[2], n, checksum; /* checksum: XXH3 of the content, seeded with the key */
};

static struct header header_of(const uint64_t key[2], const void *bytes, size_t n)
{
	struct header h = { .key = { key[0], key[1] }, .n = n };

	memcpy(h.magic, magic, sizeof(magic));
	h.checksum = XXH3_64bits_withSeed(bytes, n, key[0] ^ key[1]);
	return h;
}

/* Read the content, after the header. @return NULL: the file is truncated, or memory is short */
static void *read_content(FILE *file, uint64_t n)
{
	void *bytes;

	if (n > SIZE_MAX / 2 || fseek(file, 0, SEEK_END) || (uint64_t)ftell(file) != sizeof(struct header) + n ||
	    fseek(file, sizeof(struct header), SEEK_SET))
		return NULL;
	bytes = malloc((size_t)n + 1);
	if (bytes && fread(bytes, 1, (size_t)n, file) != n) {
		free(bytes);
		return NULL;
	}
	return bytes;
}

int kept_read(const char *path, const uint64_t key[2], void **bytes, size_t *n)
{
	FILE *file = fopen(path, "rbe");
	struct header h, want;

	*bytes = NULL;
	if (!file)
		return 0;
	if (fread(&h, sizeof(h), 1, file) == 1)
		*bytes = read_content(file, h.n);
	fclose(file);
	if (!*bytes)
		return 0;
	want = header_of(key, *bytes, (size_t)h.n);
	*n = (size_t)h.n;
	if (memcmp(&h, &want, sizeof(h)) == 0)
		return 1;
	free(*bytes);
	*bytes = NULL;
	return 0;
}

/* @return 0 or the errno */
static int write_file(const char *path, const struct header *h, const void *bytes)
{
	FILE *file = fopen(path, "wbxe");
	int failed = 0;

	if (!file)
		return errno;
	if (fwrite(h, sizeof(*h), 1, file) != 1 || fwrite(bytes, 1, (size_t)h->n, file) != h->n)
		failed = errno;
	if (fclose(file) && !failed)
		failed = errno;
	return failed;
}

int kept_write(const char *path, const uint64_t key[2], const void *bytes, size_t n)
{
	const struct header h = header_of(key, bytes, n);
	char part[PATH_MAX + 128], folder[PATH_MAX];
	int failed;

	if (snprintf(folder, sizeof(folder), "%s", path) >= (int)sizeof(folder) || !strrchr(folder, '/'))
		return ENAMETOOLONG;
	*strrchr(folder, '/') = '\0';
	failed = folder_try(folder);
	if (failed)
		return failed;
	if (part_begin(path, part, sizeof(part)))
		return -1;
	failed = write_file(part, &h, bytes);
	if (failed)
		part_drop(part);
	else if (part_finish(part, path))
		failed = -1;
	return failed;
}
