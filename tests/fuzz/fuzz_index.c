/*
 * An index beside its trace. The input is the table of contents' size (32 bits, low byte first), the table, and the
 * blobs before it; header and checksum are added. Each checkpoint is restored, and the calls after it are executed.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/hash.h"
#include "replay/gl/dispatch.h"
#include "replay/index/index_file.h"
#include "replay/index/snapshot_layout.h"
#include "tests/fuzz/target.h"

#define TRACE "tests/golden/cornell.trace"
#define MOST_CHECKPOINTS 4
#define MOST_CALLS 200

static char trace[4096], hash[33];
static struct stat info;

static void make_trace(void)
{
	static uint8_t bytes[1 << 22];
	FILE *file = fopen(TRACE, "rb");
	size_t n = file ? fread(bytes, 1, sizeof(bytes), file) : 0;

	if (!n)
		abort();
	fclose(file);
	target_write("x.trace", bytes, n, trace);
	if (stat(trace, &info) || hash_name(trace, (uint64_t)info.st_size, hash))
		abort();
}

static void write_index(const uint8_t *toc, size_t n_toc, const uint8_t *blobs, size_t n_blobs)
{
	struct index_header head = { .layout = snapshot_layout(), .trace_bytes = (uint64_t)info.st_size,
		                     .trace_mtime_ns = (uint64_t)info.st_mtim.tv_sec * 1000000000u + (uint64_t)info.st_mtim.tv_nsec,
		                     .toc_offset = sizeof(head) + n_blobs, .toc_packed = n_toc, .toc_bytes = n_toc };
	uint8_t *all = malloc(sizeof(head) + n_blobs + n_toc + 1);
	char path[4096];

	if (!all)
		abort();
	memcpy(head.magic, INDEX_MAGIC, sizeof(head.magic));
	memcpy(head.trace_hash, hash, sizeof(head.trace_hash));
	hash_bytes(toc, n_toc, head.toc_hash);
	memcpy(all, &head, sizeof(head));
	memcpy(all + sizeof(head), blobs, n_blobs);
	memcpy(all + sizeof(head) + n_blobs, toc, n_toc);
	target_write("x.trace.index", all, sizeof(head) + n_blobs + n_toc, path);
	free(all);
}

static void go_on(struct index *index, uint64_t frame)
{
	struct trace_reader *r = NULL;
	struct gls_exec *x = NULL;
	const struct call *call;

	if (!trace_reader_open(&r, trace, gls_command_find) && !gls_exec_create(&x, trace) &&
	    !index_restore(index, frame, r, x))
		for (int i = 0; i < MOST_CALLS && trace_reader_next(r, &call) == 1 && !gls_exec_call(x, call); i++)
			;
	gls_exec_destroy(&x);
	trace_reader_close(&r);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct index *index = NULL;
	const struct index_lack *lacks;
	uint64_t call, offset, frame = UINT64_MAX;
	uint32_t n_toc;

	if (!trace[0])
		make_trace();
	if (!target_take(&data, &size, &n_toc, sizeof(n_toc)) || n_toc > size)
		return 0;
	write_index(data, n_toc, data + n_toc, size - n_toc);
	if (!index_create(&index, trace, hash) && index_load(index)) {
		struct index_facts facts = index_facts(index);

		index_frame(index, facts.frames / 2, &call, &offset);
		for (size_t i = 0, n = index_lacks(index, &lacks); i < n; i++)
			printf("%.64s %.128s\n", lacks[i].name, lacks[i].why);
		for (int i = 0; i < MOST_CHECKPOINTS && frame; i++) {
			frame = index_checkpoint(index, frame);
			if (frame)
				go_on(index, frame--);
		}
	}
	index_close(&index);
	return 0;
}
