#include "tests/fuzz/target.h"

#include <snappy-c.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/folder.h"

#define CHUNK ((size_t)1 << 20)

static char folder[2048];

/* Messages about damaged input are of no interest. A target that needs more setup has a function of its own. */
__attribute__((weak)) int LLVMFuzzerInitialize(int *argc, char ***argv)
{
	(void)argc;
	(void)argv;
	return freopen("/dev/null", "w", stdout) ? 0 : 1;
}

static void write_all(int file, const uint8_t *data, size_t size)
{
	while (size) {
		ssize_t n = write(file, data, size);

		if (n <= 0)
			abort();
		data += n;
		size -= (size_t)n;
	}
}

int target_file(const uint8_t *data, size_t size, char path[32])
{
	int file = memfd_create("fuzz", MFD_CLOEXEC);

	if (file < 0)
		abort();
	write_all(file, data, size);
	snprintf(path, 32, "/proc/self/fd/%d", file);
	return file;
}

void target_end(void)
{
	if (folder[0])
		folder_remove(folder);
	folder[0] = '\0';
}

const char *target_folder(void)
{
	const char *parent = getenv("TMPDIR");

	if (folder[0])
		return folder;
	snprintf(folder, sizeof(folder), "%s/fuzz-XXXXXX", parent ? parent : "/dev/shm");
	if (!mkdtemp(folder))
		abort();
	atexit(target_end);
	return folder;
}

void target_write(const char *name, const uint8_t *data, size_t size, char path[4096])
{
	FILE *file;

	snprintf(path, 4096, "%s/%s", target_folder(), name);
	file = fopen(path, "wb");
	if (!file || fwrite(data, 1, size, file) != size || fclose(file))
		abort();
}

uint8_t *target_pack(const uint8_t *stream, size_t size, size_t *n)
{
	const size_t most = snappy_max_compressed_length(CHUNK) + 4;
	uint8_t *out = malloc(2 + (size / CHUNK + 1) * most);

	if (!out)
		abort();
	memcpy(out, "at", 2);
	*n = 2;
	for (size_t at = 0; at < size; at += CHUNK) {
		size_t packed = most - 4, part = size - at < CHUNK ? size - at : CHUNK;
		uint32_t length;

		if (snappy_compress((const char *)stream + at, part, (char *)out + *n + 4, &packed) != SNAPPY_OK)
			abort();
		length = (uint32_t)packed;
		memcpy(out + *n, &length, 4);
		*n += 4 + packed;
	}
	return out;
}

int target_take(const uint8_t **data, size_t *size, void *out, size_t n)
{
	if (*size < n)
		return 0;
	memcpy(out, *data, n);
	*data += n;
	*size -= n;
	return 1;
}
