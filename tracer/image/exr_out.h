/*
 * A buffered output file for OpenEXRCore, which writes each chunk in five pieces. They are combined into larger writes.
 */
#pragma once

#include <openexr.h>
#include <stdint.h>

#define EXR_OUT_BYTES 262144

struct exr_out {
	int file;
	int reason; /* errno of the first failure; 0: none */
	uint64_t at; /* offset of `bytes` in the file */
	size_t n;    /* bytes in the buffer */
	unsigned char bytes[EXR_OUT_BYTES];
};

/**
 * Create a file, and set `setup` to write to it, for exr_start_write.
 * @param out  kept until exr_out_close
 * @return 0 or -1 (out->reason is set)
 */
int exr_out_open(struct exr_out *out, const char *path, exr_context_initializer_t *setup);

/** Write the rest and close the file. Call after exr_finish. @return 0 or -1 (out->reason is set) */
int exr_out_close(struct exr_out *out);
