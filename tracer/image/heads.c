#include "tracer/image/heads.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/err.h"

#define LITTLE_BYTES ((uint64_t)1 << 20) /* allocations below this are harmless */

static uint32_t number(const uint8_t b[4], int big)
{
	return big ? (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3] :
	             (uint32_t)b[3] << 24 | (uint32_t)b[2] << 16 | (uint32_t)b[1] << 8 | b[0];
}

static uint64_t bytes_left(FILE *file, uint64_t file_bytes)
{
	const long at = ftell(file);

	return at >= 0 && (uint64_t)at < file_bytes ? file_bytes - (uint64_t)at : 0;
}

/* Does a part of `length` bytes end within the file, or only a little beyond? */
static int fits(FILE *file, uint64_t file_bytes, uint64_t length)
{
	return length <= bytes_left(file, file_bytes) + LITTLE_BYTES;
}

/* PNG 1.2, sec. 3.2: length, type, data and checksum of each chunk. */
static int png_fits(FILE *file, uint64_t file_bytes)
{
	uint8_t head[8];

	for (int err = fseek(file, 8, SEEK_SET); !err && fread(head, 1, 8, file) == 8;
	     err = fseek(file, (long)number(head, 1) + 4, SEEK_CUR))
		if (!fits(file, file_bytes, number(head, 1)))
			return 0;
	return 1;
}

/* Read a string up to its NUL; `first` receives its first bytes. @return its whole length */
static size_t take_text(FILE *file, char first[32])
{
	size_t n = 0;

	for (int c = getc(file); c > 0; c = getc(file), n++)
		if (n < 31)
			first[n] = (char)c;
	first[n < 31 ? n : 31] = '\0';
	return n;
}

/* The OpenEXR library reads values of these types without checking their size, and continues after what it read. */
static int type_has_size(const char *type, uint32_t size)
{
	static const struct {
		const char *name;
		uint32_t bytes;
	} fixed[] = { { "box2i", 16 },      { "box2f", 16 },   { "chromaticities", 32 },
		      { "compression", 1 }, { "double", 8 },   { "envmap", 1 },
		      { "float", 4 },       { "int", 4 },      { "keycode", 28 },
		      { "lineOrder", 1 },   { "m33f", 36 },    { "m33d", 72 },
		      { "m44f", 64 },       { "m44d", 128 },   { "rational", 8 },
		      { "tiledesc", 9 },    { "timecode", 8 }, { "v2i", 8 },
		      { "v2f", 8 },         { "v2d", 16 },     { "v3i", 12 },
		      { "v3f", 12 },        { "v3d", 24 } };

	for (size_t i = 0; i < sizeof(fixed) / sizeof(fixed[0]); i++)
		if (strcmp(type, fixed[i].name) == 0)
			return size == fixed[i].bytes;
	return 1;
}

/* OpenEXR file layout: after magic number and version come headers. Each is a list of attributes (name, type, size,
 * value) that ends with an empty name. */
static int exr_fits(FILE *file, uint64_t file_bytes, int parts)
{
	uint8_t size[4];
	char text[32];

	if (fseek(file, 8, SEEK_SET))
		return 1;
	for (;;) {
		int attributes = 0;

		for (; take_text(file, text); attributes++) {
			take_text(file, text);
			if (fread(size, 1, 4, file) != 4)
				return 1;
			if (number(size, 0) > bytes_left(file, file_bytes) || !type_has_size(text, number(size, 0)))
				return 0;
			if (fseek(file, (long)number(size, 0), SEEK_CUR))
				return 1;
		}
		if (!parts || !attributes || feof(file))
			return 1;
	}
}

/* SMPTE 268M: the size of the user data is at offset 32. */
static int dpx_fits(FILE *file, uint64_t file_bytes, int big)
{
	uint8_t size[4];

	return fseek(file, 32, SEEK_SET) || fread(size, 1, 4, file) != 4 || number(size, big) == UINT32_MAX /* undefined */ ||
	       fits(file, file_bytes, number(size, big));
}

/* GIF89a, sec. 18: the width and height of the screen are at offset 6. The longest LZW code, 12 bits, represents less
 * than 4096 pixels. */
static int gif_fits(FILE *file, uint64_t file_bytes)
{
	uint8_t size[4];
	uint64_t pixels;

	if (fseek(file, 6, SEEK_SET) || fread(size, 1, 4, file) != 4)
		return 1;
	pixels = (uint64_t)(size[0] | size[1] << 8) * (uint64_t)(size[2] | size[3] << 8);
	return pixels <= 16 * LITTLE_BYTES + 4096 * file_bytes;
}

int heads_check(const char *path)
{
	uint8_t head[8] = { 0 };
	FILE *file = fopen(path, "rb");
	struct stat info;
	int good = 1, icon = 0;

	if (file && fstat(fileno(file), &info) == 0 && S_ISREG(info.st_mode) && fread(head, 1, 8, file) == 8) {
		if (memcmp(head, "\x89PNG\r\n\x1a\n", 8) == 0)
			good = png_fits(file, (uint64_t)info.st_size);
		else if (memcmp(head, "\x76\x2f\x31\x01", 4) == 0)
			good = exr_fits(file, (uint64_t)info.st_size, head[5] >> 4 & 1);
		else if (memcmp(head, "SDPX", 4) == 0 || memcmp(head, "XPDS", 4) == 0)
			good = dpx_fits(file, (uint64_t)info.st_size, head[0] == 'S');
		else if (memcmp(head, "GIF", 3) == 0) /* giflib checks no more bytes */
			good = gif_fits(file, (uint64_t)info.st_size);
		else
			icon = memcmp(head, "\0\0\1", 4) == 0;
	}
	if (file)
		fclose(file);
	if (icon)
		return err_report(ERR_INPUT, path, "is an icon; pictures of this format are not read");
	return good ? 0 : err_report(ERR_INPUT, path, "is damaged: its head claims more bytes than the file has");
}
