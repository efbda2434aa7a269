/*
 * Runs inside the traced program. Reference frames: what the program shows, read back just before it is swapped (ref.h).
 *
 * Every state that reading depends on is set to its initial value and put back; queries go to the driver, so no cache can
 * be wrong. GL errors that are pending are kept aside, the ones made here are dropped.
 */
#include <GL/gl.h>
#include <GL/glext.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <snappy-c.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#include "capture/format/ref.h"
#include "capture/write/sink.h"
#include "capture/stats.h"
#include "capture/gl/wrap.h"

enum { HEADER_BYTES = 28, LOW_FD = 100 };

static struct {
	int color, depth;
	_Atomic int failed;
	uint64_t every;
	char path[STATS_PATH_BYTES];
	uint64_t bytes;
	void *pixels, *packed; /* kept from frame to frame */
	size_t pixels_bytes, packed_bytes;
} r;

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

/* State */

static const unsigned pack_state[] = { GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST,   GL_PACK_ROW_LENGTH,
	                               GL_PACK_SKIP_ROWS,  GL_PACK_SKIP_PIXELS, GL_PACK_ALIGNMENT };
static const unsigned transfer_state[] = { GL_RED_SCALE, GL_RED_BIAS, GL_GREEN_SCALE, GL_GREEN_BIAS, GL_BLUE_SCALE,
	                                   GL_BLUE_BIAS, GL_ALPHA_SCALE, GL_ALPHA_BIAS, GL_DEPTH_SCALE, GL_DEPTH_BIAS };
enum {
	N_PACK = sizeof(pack_state) / sizeof(pack_state[0]),
	N_TRANSFER = sizeof(transfer_state) / sizeof(transfer_state[0])
};

_Static_assert((int)N_PACK == (int)READING_PACK && (int)N_TRANSFER == (int)READING_TRANSFER, "wrap.h has room for what is saved");

static unsigned read_target(void)
{
	return context_has(HAS_READ_FRAMEBUFFER) ? GL_READ_FRAMEBUFFER : GL_FRAMEBUFFER;
}

void reading_begin(struct reading_state *s)
{
	if (context_has(HAS_FRAMEBUFFERS)) {
		s->framebuffer = context_get(context_has(HAS_READ_FRAMEBUFFER) ? GL_READ_FRAMEBUFFER_BINDING :
		                                                               GL_FRAMEBUFFER_BINDING);
		if (s->framebuffer)
			real_glBindFramebuffer(read_target(), 0);
		/* What is drawn to says what there are: buffers, bits, samples. */
		s->draw_framebuffer = context_has(HAS_READ_FRAMEBUFFER) ? context_get(GL_DRAW_FRAMEBUFFER_BINDING) : 0;
		if (s->draw_framebuffer)
			real_glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
	}
	s->read_buffer = context_get(GL_READ_BUFFER);
	real_glReadBuffer(context_get(GL_DOUBLEBUFFER) ? GL_BACK : GL_FRONT);
	if (context_has(HAS_PIXEL_BUFFERS)) {
		s->pack_buffer = context_get(GL_PIXEL_PACK_BUFFER_BINDING);
		if (s->pack_buffer)
			real_glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
	}
	for (int i = 0; i < N_PACK; i++) {
		s->pack[i] = context_get(pack_state[i]);
		real_glPixelStorei(pack_state[i], pack_state[i] == GL_PACK_ALIGNMENT ? 4 : 0);
	}
	if (context_has(HAS_PACK_INVERT)) {
		s->pack_invert = context_get(GL_PACK_INVERT_MESA);
		real_glPixelStorei(GL_PACK_INVERT_MESA, 0);
	}
	if (!context_has(HAS_FIXED_FUNCTION))
		return;
	s->map_color = context_get(GL_MAP_COLOR);
	if (s->map_color)
		real_glPixelTransferi(GL_MAP_COLOR, 0);
	for (int i = 0; i < N_TRANSFER; i++) { /* scales and biases take turns */
		float initial = i % 2 ? 0.0f : 1.0f;

		real_glGetFloatv(transfer_state[i], &s->transfer[i]);
		if (s->transfer[i] != initial)
			real_glPixelTransferf(transfer_state[i], initial);
	}
}

void reading_end(const struct reading_state *s)
{
	if (context_has(HAS_FIXED_FUNCTION)) {
		for (int i = 0; i < N_TRANSFER; i++)
			if (s->transfer[i] != (i % 2 ? 0.0f : 1.0f))
				real_glPixelTransferf(transfer_state[i], s->transfer[i]);
		if (s->map_color)
			real_glPixelTransferi(GL_MAP_COLOR, s->map_color);
	}
	if (context_has(HAS_PACK_INVERT))
		real_glPixelStorei(GL_PACK_INVERT_MESA, s->pack_invert);
	for (int i = 0; i < N_PACK; i++)
		real_glPixelStorei(pack_state[i], s->pack[i]);
	if (s->pack_buffer)
		real_glBindBuffer(GL_PIXEL_PACK_BUFFER, (unsigned)s->pack_buffer);
	real_glReadBuffer((unsigned)s->read_buffer);
	if (s->framebuffer)
		real_glBindFramebuffer(read_target(), (unsigned)s->framebuffer);
	if (s->draw_framebuffer)
		real_glBindFramebuffer(GL_DRAW_FRAMEBUFFER, (unsigned)s->draw_framebuffer);
}

/*
 * A window with several samples a pixel shows their mean, and glReadPixels need not: Mesa's software rasterizers give one sample
 * (22.3.6). So what the window will show is made as the driver makes it at the swap, by a blit, in a renderbuffer that lives while it
 * is read.
 */
static void read_resolved(int width, int height, void *pixels)
{
	int renderbuffer = context_get(GL_RENDERBUFFER_BINDING);
	unsigned framebuffer = 0, colors = 0, scissor = real_glIsEnabled(GL_SCISSOR_TEST), srgb = real_glIsEnabled(GL_FRAMEBUFFER_SRGB);

	real_glGenFramebuffers(1, &framebuffer);
	real_glGenRenderbuffers(1, &colors);
	real_glBindRenderbuffer(GL_RENDERBUFFER, colors);
	real_glRenderbufferStorage(GL_RENDERBUFFER, context_get(GL_ALPHA_BITS) > 0 ? GL_RGBA8 : GL_RGB8, width, height);
	real_glBindRenderbuffer(GL_RENDERBUFFER, (unsigned)renderbuffer);
	real_glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
	real_glFramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colors);
	if (scissor)
		real_glDisable(GL_SCISSOR_TEST);
	if (srgb)
		real_glDisable(GL_FRAMEBUFFER_SRGB);
	real_glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
	if (scissor)
		real_glEnable(GL_SCISSOR_TEST);
	if (srgb)
		real_glEnable(GL_FRAMEBUFFER_SRGB);
	real_glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
	real_glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
	real_glBindFramebuffer(GL_FRAMEBUFFER, 0);
	real_glDeleteFramebuffers(1, &framebuffer);
	real_glDeleteRenderbuffers(1, &colors);
}

void reading_colors(int width, int height, void *pixels)
{
	if (context_has(HAS_DESKTOP) && context_has(HAS_FRAMEBUFFERS) && context_has(HAS_READ_FRAMEBUFFER) && context_get(GL_SAMPLES) > 1)
		read_resolved(width, height, pixels);
	else
		real_glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
}

/* The file */

static void fail(const char *what, int error)
{
	r.failed = 1;
	writer_say("%s: %s: %s; no more reference frames, the program goes on", r.path, what, strerror(error));
}

/* Maps `bytes`, kept for the next frame. Not malloc: the program may have replaced it, or be short of it. */
static void *grow(void **buffer, size_t *have, size_t bytes)
{
	void *more;

	if (*have >= bytes)
		return *buffer;
	more = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
	if (more == MAP_FAILED)
		return NULL;
	if (*buffer)
		munmap(*buffer, *have);
	*buffer = more;
	*have = bytes;
	return more;
}

static void put_le(uint8_t *p, uint64_t v, unsigned n)
{
	while (n--) {
		*p++ = (uint8_t)v;
		v >>= 8;
	}
}

/* The file is opened for each record: a program may close descriptors that are not its own. */
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

static void write_record(enum ref_kind kind, uint64_t frame, int width, int height)
{
	size_t bytes = (size_t)width * (size_t)height * 4, packed = snappy_max_compressed_length(bytes);
	uint8_t *record = grow(&r.packed, &r.packed_bytes, packed + HEADER_BYTES);

	if (!record || snappy_compress(r.pixels, bytes, (char *)record + HEADER_BYTES, &packed) != SNAPPY_OK) {
		fail("no memory", ENOMEM);
		return;
	}
	put_le(record, kind, 4);
	put_le(record + 4, (uint64_t)width, 4);
	put_le(record + 8, (uint64_t)height, 4);
	put_le(record + 12, frame, 8);
	put_le(record + 20, packed, 8);
	append(record, packed + HEADER_BYTES);
}

/* 0 where the pixels of a frame have room and the file is begun. */
static int make_ready(int width, int height)
{
	if (!r.path[0]) {
		if (writer_sidecar(r.path, sizeof(r.path), ".ref"))
			return -1;
		append(REF_MAGIC, strlen(REF_MAGIC));
	}
	if (!grow(&r.pixels, &r.pixels_bytes, (size_t)width * (size_t)height * 4)) {
		fail("no memory", ENOMEM);
		return -1;
	}
	return 0;
}

/* What is drawn to in a window with a back buffer is its front buffer, alone or too. */
static int draws_to_front(void)
{
	int buffer = context_has(HAS_DESKTOP) && context_get(GL_DOUBLEBUFFER) ? context_get(GL_DRAW_BUFFER) : GL_BACK;

	return buffer == GL_FRONT || buffer == GL_FRONT_LEFT || buffer == GL_LEFT || buffer == GL_FRONT_AND_BACK;
}

void reference_read(uint64_t frame, int width, int height, int unswapped)
{
	static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
	struct reading_state state = { 0 };
	int saved = errno, list = context_has(HAS_FIXED_FUNCTION) ? context_get(GL_LIST_INDEX) : 0;

	/* While a list is compiled the selection of the buffer to read would go into the list. */
	if (list || width <= 0 || height <= 0)
		return;
	pthread_mutex_lock(&lock);
	if (make_ready(width, height))
		goto done;
	context_errors_before();
	reading_begin(&state);
	if (unswapped && draws_to_front())
		real_glReadBuffer(GL_FRONT);
	if (r.color && !r.failed) {
		reading_colors(width, height, r.pixels);
		write_record(REF_COLOR, frame, width, height);
	}
	if (r.depth && !r.failed && context_get(GL_DEPTH_BITS) > 0) {
		real_glReadPixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, r.pixels);
		write_record(REF_DEPTH, frame, width, height);
	}
	reading_end(&state);
	context_errors_after();
done:
	pthread_mutex_unlock(&lock);
	errno = saved;
}
