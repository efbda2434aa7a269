/* Runs inside the traced program. */
#include "capture/write/sink.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <linux/futex.h>
#include <pthread.h>
#include <signal.h>
#include <snappy-c.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include "capture/stats.h"
#include "capture/write/pages.h"

enum {
	N_CHUNKS = 8,
	AT_ONCE = 16 << 10,
	LOW_FD = 100,
	MAX_PROCESSES = 10000,
	STACK_BYTES = 256 << 10,
	WAIT_NS = 100000000
};

static struct {
	uint8_t *chunks[N_CHUNKS];
	size_t used[N_CHUNKS];
	struct sink_content contents[N_CHUNKS];
	_Atomic uint32_t handed, written; /* chunks so far; those between wait for the thread. Both are futexes */
	_Atomic int waiting;              /* somebody waits for `written` */
	_Atomic pid_t thread;             /* 0: there is none */
	int tried;                        /* to start it */

	/* Used by the thread if chunks wait for it, else by the caller. */
	char *packed;
	int fd;
	dev_t device;
	ino_t inode;
	_Atomic uint64_t bytes, frames, calls;
	_Atomic int error;
	const char *what;
	char path[STATS_PATH_BYTES];
} sink = { .fd = -1 };

/* The file */

static void fail(int error, const char *what)
{
	if (sink.error)
		return;
	sink.what = what;
	sink.error = error;
	if (sink.fd >= 0 && ftruncate(sink.fd, (off_t)sink.bytes))
		sink.what = "cannot write, nor cut off the last part";
}

/* A program may close our descriptor and get its number for a file of its own. Returns 0 or an errno. */
static int own_file(void)
{
	struct stat st;
	int fd;

	if (sink.fd >= 0 && fstat(sink.fd, &st) == 0 && st.st_dev == sink.device && st.st_ino == sink.inode)
		return 0;
	sink.fd = -1;
	fd = open(sink.path, O_WRONLY | O_CLOEXEC);
	if (fd < 0)
		return errno;
	if (fstat(fd, &st) || st.st_dev != sink.device || st.st_ino != sink.inode) {
		close(fd);
		return ENOENT;
	}
	sink.fd = fd;
	return 0;
}

void sink_explain(char *out, size_t size, const char *what, int error)
{
	const char *plain = error == ENOSPC ? "disk full" : error == EDQUOT ? "disk quota exceeded" :
	                    error == EFBIG ? "file size limit reached" : NULL;

	if (plain)
		snprintf(out, size, "%s", plain);
	else
		snprintf(out, size, "%s: %s", what, strerror(error));
}

int sink_pwrite(int fd, const void *data, size_t bytes, uint64_t offset)
{
	const char *at = data;
	struct rlimit limit;

	/* The kernel sends SIGXFSZ to a program that writes beyond this. */
	if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY && offset + bytes > limit.rlim_cur)
		return EFBIG;
	while (bytes) {
		ssize_t n = pwrite(fd, at, bytes, (off_t)offset);

		if (n < 0 && errno == EINTR)
			continue;
		if (n <= 0)
			return n ? errno : EIO;
		at += n;
		bytes -= (size_t)n;
		offset += (uint64_t)n;
	}
	return 0;
}

/*
 * A killed process leaves only whole chunks. A kill can cut a write of many pages short, so the length, which makes it
 * a chunk, is written last.
 */
static void append(size_t packed)
{
	enum { ONE_PAGE = 4096 };
	int error = own_file();

	for (int i = 0; i < 4; i++)
		sink.packed[i] = (char)(packed >> (8 * i));
	if (!error && packed + 4 <= ONE_PAGE) {
		error = sink_pwrite(sink.fd, sink.packed, packed + 4, sink.bytes);
	} else if (!error) {
		error = sink_pwrite(sink.fd, sink.packed + 4, packed, sink.bytes + 4);
		if (!error)
			error = sink_pwrite(sink.fd, sink.packed, 4, sink.bytes);
	}
	if (error)
		fail(error, "cannot write");
	else
		sink.bytes += packed + 4;
}

static void pack(const uint8_t *chunk, size_t bytes, struct sink_content content)
{
	size_t packed = snappy_max_compressed_length(SINK_CHUNK);

	if (sink.error || !bytes)
		return;
	if (snappy_compress((const char *)chunk, bytes, sink.packed + 4, &packed) != SNAPPY_OK)
		fail(EINVAL, "cannot pack");
	else
		append(packed);
	if (!sink.error) {
		sink.frames = content.frames;
		sink.calls = content.calls;
	}
}

static int create_file(const char *name)
{
	size_t stem = strlen(name);
	struct stat st;
	int fd = -1;

	if (stem > 6 && strcmp(name + stem - 6, ".trace") == 0)
		stem -= 6;
	for (int i = 0; i < MAX_PROCESSES && fd < 0; i++) {
		int n = i ? snprintf(sink.path, sizeof(sink.path), "%.*s.%d%s", (int)stem, name, i, name + stem)
		          : snprintf(sink.path, sizeof(sink.path), "%s", name);

		if (n >= (int)sizeof(sink.path))
			return ENAMETOOLONG;
		fd = open(sink.path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
		if (fd < 0 && errno != EEXIST)
			return errno;
	}
	if (fd < 0)
		return EEXIST;
	sink.fd = fcntl(fd, F_DUPFD_CLOEXEC, LOW_FD);
	if (sink.fd < 0)
		sink.fd = fd;
	else
		close(fd);
	if (fstat(sink.fd, &st))
		return errno;
	sink.device = st.st_dev;
	sink.inode = st.st_ino;
	return 0;
}

/* The thread */

static long futex(_Atomic uint32_t *word, int operation, uint32_t value, const struct timespec *patience)
{
	return syscall(SYS_futex, word, operation | FUTEX_PRIVATE_FLAG, value, patience, NULL, 0);
}

/* Pack the next chunk that waits. */
static void take_one(void)
{
	uint32_t n = sink.written;

	pack(sink.chunks[n % N_CHUNKS], sink.used[n % N_CHUNKS], sink.contents[n % N_CHUNKS]);
	sink.written = n + 1;
	if (sink.waiting)
		futex(&sink.written, FUTEX_WAKE, INT_MAX, NULL);
}

static void *pack_chunks(void *nothing)
{
	(void)nothing;
	sink.thread = (pid_t)syscall(SYS_gettid);
	for (;;) {
		uint32_t handed = sink.handed;

		if (handed == sink.written)
			futex(&sink.handed, FUTEX_WAIT, handed, NULL);
		else
			take_one();
	}
	return NULL;
}

/* Signals are blocked in it. If it cannot be started, the caller does its work. */
static void start_thread(void)
{
	pthread_attr_t attributes;
	sigset_t all, before;
	pthread_t thread;

	sink.tried = 1;
	if (pthread_attr_init(&attributes))
		return;
	pthread_attr_setstacksize(&attributes, STACK_BYTES);
	pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
	sigfillset(&all);
	pthread_sigmask(SIG_SETMASK, &all, &before);
	sink.thread = -1; /* being started */
	if (pthread_create(&thread, &attributes, pack_chunks, NULL))
		sink.thread = 0;
	pthread_sigmask(SIG_SETMASK, &before, NULL);
	pthread_attr_destroy(&attributes);
}

/* Wait until at most this many chunks are left. */
static void wait_for_thread(uint32_t at_most)
{
	const struct timespec patience = { 0, WAIT_NS };
	uint32_t written;

	while (sink.handed - (written = sink.written) > at_most) {
		sink.waiting = 1;
		if (futex(&sink.written, FUTEX_WAIT, written, &patience) && errno == ETIMEDOUT && sink.thread > 0 &&
		    syscall(SYS_tgkill, getpid(), sink.thread, 0) && errno == ESRCH)
			sink.thread = 0; /* a copy of the process made without fork has no such thread */
		while (!sink.thread && sink.handed != sink.written)
			take_one();
	}
	sink.waiting = 0;
}

/* The caller */

static uint8_t *hand_over(size_t bytes, struct sink_content content, int now)
{
	uint32_t n = sink.handed;
	int idle = n == sink.written;

	if (!bytes || (idle && (bytes <= AT_ONCE || !sink.thread))) {
		if (now)
			wait_for_thread(0);
		if (bytes && n == sink.written)
			pack(sink.chunks[n % N_CHUNKS], bytes, content);
		return sink.chunks[n % N_CHUNKS];
	}
	sink.used[n % N_CHUNKS] = bytes;
	sink.contents[n % N_CHUNKS] = content;
	sink.handed = n + 1;
	futex(&sink.handed, FUTEX_WAKE, 1, NULL);
	wait_for_thread(now ? 0 : N_CHUNKS - 2);
	return sink.chunks[(n + 1) % N_CHUNKS];
}

uint8_t *sink_hand_over(size_t bytes, struct sink_content content)
{
	int saved = errno;
	uint8_t *next;

	if (!sink.tried && bytes > AT_ONCE)
		start_thread();
	next = hand_over(bytes, content, 0);
	errno = saved;
	return next;
}

uint8_t *sink_write(size_t bytes, struct sink_content content)
{
	int saved = errno;
	uint8_t *next = hand_over(bytes, content, 1);

	errno = saved;
	return next;
}

struct sink_state sink_state(void)
{
	return (struct sink_state){ sink.path, sink.error, sink.what, sink.bytes, { sink.frames, sink.calls } };
}

uint8_t *sink_open(const char *name)
{
	int saved = errno, error;

	for (int i = 0; i < N_CHUNKS && !sink.chunks[N_CHUNKS - 1]; i++)
		sink.chunks[i] = pages_map(SINK_CHUNK); /* costs memory only once it is used */
	if (!sink.packed)
		sink.packed = pages_map(snappy_max_compressed_length(SINK_CHUNK) + 4);
	error = !sink.chunks[N_CHUNKS - 1] || !sink.packed ? ENOMEM : create_file(name);
	if (!error && (error = sink_pwrite(sink.fd, "at", 2, 0)) == 0)
		sink.bytes = 2;
	if (error)
		fail(error, error == ENOMEM ? "no memory" : "cannot create");
	errno = saved;
	return error ? NULL : sink.chunks[sink.handed % N_CHUNKS];
}

void sink_leave(void)
{
	if (sink.fd >= 0)
		close(sink.fd);
	sink.fd = -1;
	sink.path[0] = '\0';
	sink.bytes = sink.frames = sink.calls = 0;
	sink.error = 0;
	sink.thread = 0;
	sink.tried = 0;
	sink.waiting = 0;
}
