/*
 * A picture in memory: float, one plane per channel, row 0 is the TOP row (GL's row 0 is the bottom one).
 *
 * Channel names are those of the EXR file ("R", "gl.R", "shadow.G", "Z", "id"). Colours are linear light with Rec.709
 * primaries unless attribute "relume:encoding" says "display"; ids are exact integers.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

struct image_channel {
	char name[32];
	int full_float;   /* 1: stored as 32-bit float in a file, 0: half */
	float *values;    /* [height][width]; NULL until somebody asks for `halves` as floats */
	uint16_t *halves; /* the same as half floats, or NULL: what the renderer makes, and files take as it is */
};

struct image_attribute {
	char name[48];
	char *text; /* owned */
};

struct image {
	uint32_t width, height;
	/*
	 * 0: planes hold the whole picture. Else so many threads pack rows as they come (image_take_rows), and planes
	 * hold those from row `first` on that are too few to be packed. Such an image can be written, and nothing else.
	 */
	unsigned packers;
	uint32_t first, taken; /* taken: so many rows have come, from the top */
	struct pack *pack; /* owned; what has become of the rows above `first` */
	struct image_channel *channels; /* owned, in the order they were added */
	size_t n_channels;
	struct image_attribute *attributes; /* owned; relume:trace, relume:frame, relume:device, ... */
	size_t n_attributes;
	uint8_t *outside; /* owned; [height][width]: 1 where its file has no pixel (place.h); NULL: nowhere */
};

/** Free everything; the struct is empty (all zero) afterwards. */
void image_free(struct image *img);

/**
 * Add a channel, all 0.
 * @return its plane, valid until image_free (adding channels does not move planes), or NULL: out of memory (reported)
 */
float *image_add_channel(struct image *img, const char *name, int full_float);

/** Add a channel of half floats, not set yet. @return its plane, as image_add_channel. Do not change it once floats
 * were asked for */
uint16_t *image_add_halves(struct image *img, const char *name);

/**
 * Take in the next n rows, from the top.
 * @param planes  [n_channels] a channel's rows, one behind the other: halves where it has halves, else floats; not kept
 * @return 0 or ERR_SYSTEM (reported)
 */
int image_take_rows(struct image *img, const void *const *planes, uint32_t n);

/** The plane of a channel as floats. NULL: there is none of that name, or no memory (reported) */
float *image_channel(const struct image *img, const char *name);

/** The same for channel number i. */
float *image_values(const struct image *img, size_t i);

/** Set a text attribute, replacing one of the same name. @return 0 or ERR_SYSTEM (reported) */
int image_set_attribute(struct image *img, const char *name, const char *fmt, ...)
	__attribute__((format(printf, 3, 4)));

/** The text of an attribute, or NULL. Borrowed until the image changes. */
const char *image_attribute(const struct image *img, const char *name);

/**
 * Write as OpenEXR: one part, ZIP (exr_pack.h), half or float as the channels say, channels sorted by name. Writes to a
 * temporary name beside `path` and renames it when whole. Same image, same bytes. Attributes are strings, except
 * worldToCamera and worldToNDC: their text is 16 numbers in the file's order (rows of a matrix for row vectors).
 * @return 0, or ERR_SYSTEM (reported; nothing is left under either name)
 */
int image_write_exr(const struct image *img, const char *path);

/**
 * Read an OpenEXR file of one scan-line part (what image_write_exr writes; half, float and uint channels).
 * @param img  empty; filled on success
 * @return 0, ERR_INPUT (missing or not such a file, reported) or ERR_SYSTEM (reported)
 */
int image_read_exr(struct image *img, const char *path);

/**
 * Check the head of any OpenEXR file, tiled or of several parts, too. The reader behind OpenImageIO (OpenEXR 3.1.5)
 * believes sizes in it, and takes gigabytes for a file that is damaged there.
 * @return 0, or ERR_INPUT (reported)
 */
int image_check_exr(const char *path);

/** 1 where a file is compressed by DWAA or DWAB, which OpenEXRCore 3.1.5 cannot expand and OpenImageIO can. */
int image_exr_is_dwa(const char *path);

/** A text attribute from the head of an OpenEXR file. @return 1, or 0: there is none, or it has no room in `text` */
int image_exr_text(const char *path, const char *attribute, char *text, size_t size);

/** sRGB's transfer function (IEC 61966-2-1): display-referred [0,1] to linear light and back; an odd function, also
 * beyond [0,1]. */
float image_linear_from_display(float display);
float image_display_from_linear(float linear);
