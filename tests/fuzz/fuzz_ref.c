/* Reference frames: every record listed, looked up, unpacked and copied. */
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "capture/format/ref.h"
#include "tests/fuzz/target.h"

#define MOST_RECORDS 64

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct ref_file ref = { 0 };
	char path[32], copy[4096];
	int file = target_file(data, size, path);

	snprintf(copy, sizeof(copy), "%s/copy.ref", target_folder());
	if (!ref_open(&ref, path)) {
		for (size_t i = 0; i < ref.n_entries && i < MOST_RECORDS; i++) {
			void *pixels = NULL;

			if (ref_find(&ref, ref.entries[i].kind, ref.entries[i].frame) && !ref_read(&ref, &ref.entries[i], &pixels))
				free(pixels);
		}
		if (ref.n_entries)
			ref_copy(&ref, ref.entries[0].frame, ref.entries[0].frame + 3, copy);
		ref_close(&ref);
	}
	close(file);
	return 0;
}
