/* Runs inside the traced program. */
#include "capture/gl/reference.h"

#include <GL/gl.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <snappy-c.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "capture/format/ref.h"
#include "capture/gl/context.h"
#include "capture/gl/reading.h"
#include "capture/stats.h"
#include "capture/write/pages.h"
#include "capture/write/report.h"
#include "capture/write/sink.h"
#include "capture/write/writer.h"
#include "real.h"

static struct {
	int color, depth;
	_Atomic int failed;
	uint64_t every;
	char path[STATS_PATH_BYTES];
	uint64_t bytes;
	uint8_t *pixels; /* kept from frame to frame */
	size_t pixels_bytes;
	struct readback *idle;
	pthread_mutex_t lock;
} r = { .lock = PTHREAD_MUTEX_INITIALIZER };

/* A frame's records, which wait for its number. */
struct readback {
	struct readback *next;
	uint8_t *records; /* one or two: a head, packed pixels */
	size_t mapped, bytes;
};

static __thread struct readback *waiting __attribute__((tls_model("initial-exec")));

__attribute__((constructor)) static void read_wishes(void)
{
	const char *kinds = getenv("RELUME_REF"), *every = getenv("RELUME_REF_EVERY");

	r.color = kinds && strstr(kinds, "color");
	r.depth = kinds && strstr(kinds, "depth");
	r.every = every ? strtoull(every, NULL, 10) : 1;
	if (!r.every)
		r.every = 1;
}

int reference_wanted(uint64_t frame)
{
	return (r.color || r.depth) && !r.failed && frame % r.every == 0;
}

/* The file */

static void fail(const char *what, int error)
{
	r.failed = 1;
	report_say("%s: %s: %s; no more reference frames, the program goes on", r.path, what, strerror(error));
}

/* Opens the file for each record: a program may close descriptors that are not its own. */
static void append(const void *data, size_t bytes)
{
	int fd = open(r.path, O_WRONLY | O_CREAT | O_CLOEXEC | (r.bytes ? 0 : O_TRUNC), 0666), error = 0;

	if (fd < 0) {
		fail("cannot open", errno);
		return;
	}
	error = sink_pwrite(fd, data, bytes, r.bytes);
	if (error && ftruncate(fd, (off_t)r.bytes))
		error = errno;
	close(fd);
	if (error)
		fail("cannot write", error);
	else
		r.bytes += bytes;
}

static void pack_record(enum ref_kind kind, int width, int height)
{
	size_t bytes = (size_t)width * (size_t)height * 4, packed = snappy_max_compressed_length(bytes);
	struct ref_head head = { kind, (uint32_t)width, (uint32_t)height, 0, 0 };
	uint8_t *at;

	if (!pages_grow(&waiting->records, &waiting->mapped, waiting->bytes + packed + sizeof(head))) {
		fail("no memory", ENOMEM);
		return;
	}
	at = waiting->records + waiting->bytes;
	if (snappy_compress((char *)r.pixels, bytes, (char *)at + sizeof(head), &packed) != SNAPPY_OK) {
		fail("no memory", ENOMEM);
		return;
	}
	head.packed_bytes = packed;
	memcpy(at, &head, sizeof(head));
	waiting->bytes += packed + sizeof(head);
}

/* Begin the file, and make room for a frame's pixels and records. Returns 0, or -1. */
static int make_ready(int width, int height)
{
	if (!waiting && (waiting = r.idle))
		r.idle = waiting->next;
	if (!waiting && !(waiting = pages_map(sizeof(*waiting)))) {
		fail("no memory", ENOMEM);
		return -1;
	}
	waiting->bytes = 0;
	if (!r.path[0]) {
		if (writer_sidecar(r.path, sizeof(r.path), ".ref"))
			return -1;
		append(REF_MAGIC, strlen(REF_MAGIC));
	}
	if (!pages_grow(&r.pixels, &r.pixels_bytes, (size_t)width * (size_t)height * 4)) {
		fail("no memory", ENOMEM);
		return -1;
	}
	return 0;
}

/* 1 where the window has a back buffer and yet is drawn to its front buffer. */
static int draws_to_front(void)
{
	int buffer = context_has(HAS_DESKTOP) && context_get(GL_DOUBLEBUFFER) ? context_get(GL_DRAW_BUFFER) : GL_BACK;

	return buffer == GL_FRONT || buffer == GL_FRONT_LEFT || buffer == GL_LEFT || buffer == GL_FRONT_AND_BACK;
}

void reference_read(int width, int height, int unswapped)
{
	struct reading_state state = { 0 };
	int saved = errno, list = context_has(HAS_FIXED_FUNCTION) ? context_get(GL_LIST_INDEX) : 0;

	/* A list that is being compiled would take the selection of the buffer. */
	if (list || width <= 0 || height <= 0)
		return;
	pthread_mutex_lock(&r.lock);
	if (make_ready(width, height))
		goto done;
	context_errors_before();
	reading_begin(&state);
	if (unswapped && draws_to_front())
		real_glReadBuffer(GL_FRONT);
	if (r.color && !r.failed) {
		reading_colors(width, height, r.pixels);
		pack_record(REF_COLOR, width, height);
	}
	if (r.depth && !r.failed && context_has(HAS_DESKTOP) && context_get(GL_DEPTH_BITS) > 0) { /* OpenGL ES reads no depth */
		real_glReadPixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, r.pixels);
		pack_record(REF_DEPTH, width, height);
	}
	reading_end(&state);
	context_errors_after();
done:
	pthread_mutex_unlock(&r.lock);
	errno = saved;
}

void reference_write(uint64_t frame)
{
	struct readback *read = waiting;
	struct ref_head head;
	int saved = errno;

	if (!read)
		return;
	for (size_t at = 0; at < read->bytes; at += sizeof(head) + head.packed_bytes) {
		memcpy(&head, read->records + at, sizeof(head));
		head.frame = frame - 1;
		memcpy(read->records + at, &head, sizeof(head));
	}
	pthread_mutex_lock(&r.lock);
	if (frame && read->bytes && reference_wanted(frame - 1))
		append(read->records, read->bytes);
	waiting = NULL;
	read->next = r.idle;
	r.idle = read;
	pthread_mutex_unlock(&r.lock);
	errno = saved;
}
