/* Runs inside the traced program. */
#include "capture/gl/reference.h"

#include <GL/gl.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "capture/format/ref_pack.h"
#include "capture/gl/context.h"
#include "capture/gl/reading.h"
#include "capture/stats.h"
#include "capture/write/pages.h"
#include "capture/write/report.h"
#include "capture/write/sink.h"
#include "capture/write/writer.h"
#include "real.h"

struct pages {
	uint8_t *at;
	size_t mapped;
};

static struct {
	int color, depth;
	_Atomic int failed;
	uint64_t every;
	char path[STATS_PATH_BYTES];
	uint64_t bytes;
	struct ref_last last[2];
	struct pages before[2], planes, records; /* kept from frame to frame */
	struct readback *idle;
	pthread_mutex_t lock;
} r = { .lock = PTHREAD_MUTEX_INITIALIZER };

/* A frame's pixels, colour and depth, until its number is known. */
struct readback {
	struct readback *next;
	struct pages pixels[2];
	uint32_t width[2], height[2]; /* 0: none */
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
	char reason[128];

	r.failed = 1;
	writer_note_lost_references();
	sink_explain(reason, sizeof(reason), what, error);
	report_say("%s: %s: no more reference frames; the recording goes on without them", r.path, reason);
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

static int make_room(struct pages *pages, size_t bytes)
{
	if (pages_grow(&pages->at, &pages->mapped, bytes))
		return 1;
	fail("no memory", ENOMEM);
	return 0;
}

/* Begin the file. Returns 0, or -1. */
static int make_ready(void)
{
	if (!waiting && (waiting = r.idle))
		r.idle = waiting->next;
	if (!waiting && !(waiting = pages_map(sizeof(*waiting)))) {
		fail("no memory", ENOMEM);
		return -1;
	}
	waiting->width[0] = waiting->width[1] = 0;
	if (!r.path[0]) {
		if (writer_sidecar(r.path, sizeof(r.path), ".ref"))
			return -1;
		append(REF_MAGIC, strlen(REF_MAGIC));
	}
	return 0;
}

/* Room for a kind's pixels of the current frame; NULL: there is none (reported) */
static uint8_t *place_pixels(enum ref_kind kind, int width, int height)
{
	const unsigned k = kind == REF_DEPTH;

	if (!make_room(&waiting->pixels[k], (size_t)width * (size_t)height * 4))
		return NULL;
	waiting->width[k] = (uint32_t)width;
	waiting->height[k] = (uint32_t)height;
	return waiting->pixels[k].at;
}

/* 1 if the window has a back buffer, but its front buffer is drawn to. */
static int draws_to_front(void)
{
	int buffer = context_has(HAS_DESKTOP) && context_get(GL_DOUBLEBUFFER) ? context_get(GL_DRAW_BUFFER) : GL_BACK;

	return buffer == GL_FRONT || buffer == GL_FRONT_LEFT || buffer == GL_LEFT || buffer == GL_FRONT_AND_BACK;
}

enum unread { IS_READ, NO_SIZE, IN_LIST, IN_BEGIN };

/* Why a frame cannot be read, if it cannot. */
static enum unread why_unread(int width, int height)
{
	if (width <= 0 || height <= 0)
		return NO_SIZE;
	if (!context_has(HAS_FIXED_FUNCTION))
		return IS_READ;
	if (!context_get(GL_MATRIX_MODE)) /* never 0: between glBegin and glEnd nothing can be queried */
		return IN_BEGIN;
	/* A list that is being compiled would take the selection of the buffer. */
	return context_get(GL_LIST_INDEX) ? IN_LIST : IS_READ;
}

/* Report the first occurrence only. */
static void say_unread(enum unread why)
{
	static const char *const words[] = {
		[NO_SIZE] = "in something that is neither a window nor a pixmap, or no longer exists, or with another read drawable",
		[IN_LIST] = "while a display list is made", [IN_BEGIN] = "between glBegin and glEnd",
	};
	static atomic_int said[sizeof(words) / sizeof(words[0])];

	if (!said[why]++)
		report_say("a frame ends %s; such frames get no reference frames", words[why]);
}

void reference_read(int width, int height, int unswapped)
{
	struct reading_state state = { 0 };
	const int saved = errno;
	const enum unread why = why_unread(width, height);
	uint8_t *pixels;

	if (why) {
		say_unread(why);
		errno = saved;
		return;
	}
	pthread_mutex_lock(&r.lock);
	if (make_ready())
		goto done;
	context_errors_before();
	reading_begin(&state);
	if (unswapped && draws_to_front())
		real_glReadBuffer(GL_FRONT);
	if (r.color && !r.failed && (pixels = place_pixels(REF_COLOR, width, height)))
		reading_colors(width, height, pixels);
	/* OpenGL ES cannot read depth */
	if (r.depth && !r.failed && context_has(HAS_DESKTOP) && context_get(GL_DEPTH_BITS) > 0 &&
	    (pixels = place_pixels(REF_DEPTH, width, height)))
		real_glReadPixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, pixels);
	reading_end(&state);
	context_errors_after();
done:
	pthread_mutex_unlock(&r.lock);
	errno = saved;
}

/*
 * Append a kind's record to r.records, which hold `bytes` so far, and keep its pixels for the next one. Returns its
 * size; 0: out of memory (reported)
 */
static size_t pack_record(struct readback *read, enum ref_kind kind, uint64_t frame, size_t bytes)
{
	const unsigned k = kind == REF_DEPTH;
	const struct ref_head head = { kind, read->width[k], read->height[k], frame, 0 };
	const size_t n = (size_t)head.width * head.height;
	const struct pages pixels = read->pixels[k];
	size_t more;

	if (!make_room(&r.planes, 4 * n) || !make_room(&r.records, bytes + ref_pack_room(n)))
		return 0;
	more = ref_pack(&r.last[k], &head, r.bytes + bytes, (const uint32_t *)(const void *)pixels.at,
	                (const uint32_t *)(const void *)r.before[k].at, r.planes.at, r.records.at + bytes);
	if (!more)
		fail("no memory", ENOMEM);
	read->pixels[k] = r.before[k];
	r.before[k] = pixels;
	return more;
}

static void write_records(struct readback *read, uint64_t frame)
{
	size_t bytes = 0;

	for (unsigned k = 0; k < 2 && !r.failed; k++)
		if (read->width[k])
			bytes += pack_record(read, k ? REF_DEPTH : REF_COLOR, frame, bytes);
	if (bytes && !r.failed)
		append(r.records.at, bytes);
}

void reference_write(uint64_t frame)
{
	struct readback *read = waiting;
	int saved = errno;

	if (!read)
		return;
	pthread_mutex_lock(&r.lock);
	if (frame && reference_wanted(frame - 1))
		write_records(read, frame - 1);
	waiting = NULL;
	read->next = r.idle;
	r.idle = read;
	pthread_mutex_unlock(&r.lock);
	errno = saved;
}
