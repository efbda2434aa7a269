/*
 * Where OpenEXRCore writes a file to: the library writes each chunk in five pieces, which go to the system together.
 */
#pragma once

#include <openexr.h>
#include <stdint.h>

#define EXR_OUT_BYTES 262144

struct exr_out {
	int file;
	int reason; /* errno of the first failure; 0: none */
	uint64_t at; /* where in the file `bytes` belong */
	size_t n;
	unsigned char bytes[EXR_OUT_BYTES];
};

/** Create a file for `setup`, which exr_start_write gets. out: kept until exr_out_close. @return 0, or -1: out->reason
 * says why not */
int exr_out_open(struct exr_out *out, const char *path, exr_context_initializer_t *setup);

/** After exr_finish: all is written, or out->reason says why not. @return 0 or -1 */
int exr_out_close(struct exr_out *out);
