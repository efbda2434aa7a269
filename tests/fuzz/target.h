/*
 * What libFuzzer's targets (fuzz_NAME.c) have in common. A target is one reader; the input is a file as that reader
 * gets it, or, where a checksum would refuse each change, what the checksum is taken of.
 *
 * `make fuzz` links a target with libFuzzer, `make check` and `make show-mutants` with drive.c.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/** Once, before the first input. Output of ours goes nowhere afterwards. */
int LLVMFuzzerInitialize(int *argc, char ***argv);

/** A file in memory. @param path  receives its name. @return its descriptor, which the caller closes */
int target_file(const uint8_t *data, size_t size, char path[32]);

/** A folder of this process, made at the first call and removed at exit. It has no '/' at its end. */
const char *target_folder(void);

/** Remove the folder now. */
void target_end(void);

/** Write a file below it, in place of what is there. @param path  receives its name; [4096] */
void target_write(const char *name, const uint8_t *data, size_t size, char path[4096]);

/** A trace's file, in Snappy chunks, of its logical stream (capture/format/trace.md). @return its bytes, to be freed
 * with free() */
uint8_t *target_pack(const uint8_t *stream, size_t size, size_t *n);

/** The next n bytes of an input, which then begins behind them. @return 0: it has not so many */
int target_take(const uint8_t **data, size_t *size, void *out, size_t n);
