/*
 * Shared by libFuzzer's targets (fuzz_NAME.c). A target is one reader. The input is a file as that reader gets it or,
 * if a checksum would reject every change, the data that the checksum covers.
 *
 * `make fuzz` links a target with libFuzzer, `make check` and `make show-mutants` with drive.c.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/** Called once, before the first input. Discards our output from then on. */
int LLVMFuzzerInitialize(int *argc, char ***argv);

/** A file in memory. @param path  receives its name. @return its descriptor, which the caller closes */
int target_file(const uint8_t *data, size_t size, char path[32]);

/** A folder of this process, created by the first call and removed at exit. Its name does not end with '/'. */
const char *target_folder(void);

/** Remove the folder now. */
void target_end(void);

/** Write a file in the folder, replacing an existing one. @param path  receives its name; [4096] */
void target_write(const char *name, const uint8_t *data, size_t size, char path[4096]);

/** A trace file in Snappy chunks from its logical stream (capture/format/trace.md). @return its bytes, released with
 * free() */
uint8_t *target_pack(const uint8_t *stream, size_t size, size_t *n);

/** Take the next n bytes of an input. @return 0: there are not enough */
int target_take(const uint8_t **data, size_t *size, void *out, size_t n);
