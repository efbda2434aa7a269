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
	int full_float;   /* 1: stored in files as 32-bit float; 0: as half */
	float *values;    /* [height][width]; NULL until `halves` are requested as floats */
	uint16_t *halves; /* the values as half floats, as the renderer makes them and files store them; or NULL */
};

struct image_attribute {
	char name[48];
	char *text; /* owned */
};

struct image {
	uint32_t width, height;
	/*
	 * 0: planes hold the whole picture. Otherwise the number of threads that pack rows as they arrive
	 * (image_take_rows); planes then hold only the rows from `first` on, which do not fill a chunk yet. Such an
	 * image can only be written.
	 */
	unsigned packers;
	uint32_t first, taken; /* taken: number of rows so far, from the top */
	struct pack *pack; /* owned; the packed rows above `first` */
	struct image_channel *channels; /* owned, in the order they were added */
	size_t n_channels;
	struct image_attribute *attributes; /* owned; relume:trace, relume:frame, relume:device, ... */
	size_t n_attributes;
	uint8_t *outside; /* owned; [height][width]: 1 if the file has no such pixel (place.h); NULL: it has all */
};

/** Free everything; the struct is empty (all zero) afterwards. */
void image_free(struct image *img);

/**
 * Add a channel, all 0.
 * @return its plane, valid until image_free (adding channels does not move planes), or NULL: out of memory (reported)
 */
float *image_add_channel(struct image *img, const char *name, int full_float);

/**
 * Add a channel of half floats, uninitialized.
 * @return its plane, as image_add_channel; do not change it after image_channel or image_values has returned its floats
 */
uint16_t *image_add_halves(struct image *img, const char *name);

/**
 * Add the next n rows, from the top.
 * @param planes  [n_channels] consecutive rows of each channel: halves if it has halves, else floats; not kept
 * @return 0 or ERR_SYSTEM (reported)
 */
int image_take_rows(struct image *img, const void *const *planes, uint32_t n);

/** The plane of a channel as floats. NULL: no such channel, or out of memory (reported) */
float *image_channel(const struct image *img, const char *name);

/** The same by the channel's index. Halves are converted once, at the first request. */
float *image_values(const struct image *img, size_t i);

/** Set a text attribute, replacing one of the same name. @return 0 or ERR_SYSTEM (reported) */
int image_set_attribute(struct image *img, const char *name, const char *fmt, ...)
	__attribute__((format(printf, 3, 4)));

/** The text of an attribute, or NULL. Borrowed until the image changes. */
const char *image_attribute(const struct image *img, const char *name);

/**
 * Write as OpenEXR: one part, ZIP (exr_pack.h), half or float by channel, channels sorted by name. Writes to a
 * temporary name beside `path` and renames the file when complete. The same image gives the same bytes. Attributes are
 * strings, except worldToCamera and worldToNDC: their text is 16 numbers in the file's order (rows of a matrix for row
 * vectors).
 * @return 0, or ERR_SYSTEM (reported; nothing is left under either name)
 */
int image_write_exr(const struct image *img, const char *path);

/**
 * Read an OpenEXR file with one scan-line part, like those of image_write_exr, with half, float and uint channels.
 * @param img  empty; filled on success
 * @return 0, ERR_INPUT (reported: missing or not such a file) or ERR_SYSTEM (reported)
 */
int image_read_exr(struct image *img, const char *path);

/**
 * Check the head of any OpenEXR file, including tiled and multi-part ones. OpenImageIO's reader (OpenEXR 3.1.5) trusts
 * sizes in the head, and allocates gigabytes for a file with a damaged one.
 * @return 0, or ERR_INPUT (reported)
 */
int image_check_exr(const char *path);

/** 1 if a file is compressed with DWAA or DWAB, which OpenImageIO can decompress but OpenEXRCore 3.1.5 cannot. */
int image_exr_is_dwa(const char *path);

/** Read a text attribute from the head of an OpenEXR file. @return 1; 0: there is none, or it does not fit in `text` */
int image_exr_text(const char *path, const char *attribute, char *text, size_t size);

/** sRGB's transfer function (IEC 61966-2-1): display-referred values to linear light and back. The formula also holds
 * above 1; negative values are mirrored: f(-x) = -f(x). */
float image_linear_from_display(float display);
float image_display_from_linear(float linear);
