/* Runs inside the traced program. */
#include "capture/client/watch.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/userfaultfd.h>
#include <pthread.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

enum {
	PAGE = 4096,
	MIN_PAGES = 4,
	MAX_WATCHES = 256,
	LOW_FD = 100 /* the program's own descriptors keep their numbers */
};

/* From Linux 6.7's linux/fs.h and linux/userfaultfd.h, newer than Debian 12's. */
struct scanned {
	uint64_t start, end, categories;
};
struct scan {
	uint64_t size, flags, start, end, walk_end, vec, vec_len, max_pages, category_inverted, category_mask,
		category_anyof_mask, return_mask;
};
#define SCAN_PAGES _IOWR('f', 16, struct scan)
enum { SCAN_PROTECT = 1, SCAN_ONLY_WATCHED = 2 };
enum { PAGE_WRITTEN = 2, PAGE_OF_FILE = 4, PAGE_PRESENT = 8 };
enum { FAULTS_USER_ONLY = 1 };
#define WRITE_PROTECT_ASYNC (1ull << 15)

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static struct {
	int faults, pages;       /* descriptors; open if `pid` is not 0 */
	_Atomic int tried, pid;  /* a forked child has other memory */
	struct watch watches[MAX_WATCHES];
} all;

static int open_high(int fd)
{
	int high = fd < 0 ? -1 : fcntl(fd, F_DUPFD_CLOEXEC, LOW_FD);

	if (fd >= 0)
		close(fd);
	return high;
}

/* Under the lock. */
static int available(void)
{
	struct uffdio_api api = { .api = UFFD_API, .features = WRITE_PROTECT_ASYNC };

	if (all.tried)
		return all.pid == getpid();
	all.tried = 1;
	all.faults = open_high((int)syscall(SYS_userfaultfd, O_CLOEXEC | O_NONBLOCK | FAULTS_USER_ONLY));
	all.pages = all.faults < 0 ? -1 : open_high(open("/proc/self/pagemap", O_RDONLY | O_CLOEXEC));
	if (all.pages >= 0 && ioctl(all.faults, UFFDIO_API, &api) == 0) {
		all.pid = getpid();
		return 1;
	}
	if (all.pages >= 0)
		close(all.pages);
	if (all.faults >= 0)
		close(all.faults);
	return 0;
}

/* How many pieces of [from, end) `s` asks for; -1: not known. */
static int scan(struct scan *s, uintptr_t from, uintptr_t end, struct scanned *out, int max)
{
	s->size = sizeof(*s);
	s->flags |= SCAN_ONLY_WATCHED;
	s->start = from;
	s->end = end;
	s->vec = (uintptr_t)out;
	s->vec_len = (uint64_t)max;
	return ioctl(all.pages, SCAN_PAGES, s);
}

/* 1 if all of it is present private memory, and now protected. */
static int protect(const struct watch *w)
{
	struct scan written = { .flags = SCAN_PROTECT, .category_mask = PAGE_WRITTEN, .return_mask = PAGE_WRITTEN };
	struct scan good = { .category_mask = PAGE_PRESENT | PAGE_OF_FILE,
		             .category_inverted = PAGE_OF_FILE,
		             .return_mask = PAGE_PRESENT };
	struct scanned piece;
	uintptr_t at = w->first;

	do {
		if (scan(&written, at, w->end, &piece, 1) < 0 || written.walk_end <= at)
			return 0;
		at = written.walk_end;
	} while (at < w->end);
	return scan(&good, w->first, w->end, &piece, 1) == 1 && piece.start == w->first && piece.end == w->end;
}

static void forget(const struct watch *w)
{
	struct uffdio_range range = { w->first, w->end - w->first };

	ioctl(all.faults, UFFDIO_UNREGISTER, &range);
}

int watch_begin(struct watch *w, const void *from, const void *end)
{
	struct watch wanted = { ((uintptr_t)from + PAGE - 1) & -(uintptr_t)PAGE, (uintptr_t)end & -(uintptr_t)PAGE },
		     *place = NULL;
	struct uffdio_register pages = { .range = { wanted.first, wanted.end - wanted.first },
		                         .mode = UFFDIO_REGISTER_MODE_WP };
	int saved = errno, good = 0;

	if (wanted.end < wanted.first + MIN_PAGES * PAGE || (all.tried && all.pid != getpid()))
		return 0;
	pthread_mutex_lock(&lock);
	if (!available())
		goto done;
	for (int i = 0; i < MAX_WATCHES; i++) {
		struct watch *other = &all.watches[i];

		if (other->end && other->first < wanted.end && wanted.first < other->end)
			goto done;
		if (!other->end)
			place = other;
	}
	if (!place || ioctl(all.faults, UFFDIO_REGISTER, &pages))
		goto done;
	good = protect(&wanted);
	if (good)
		*w = *place = wanted;
	else
		forget(&wanted);
done:
	pthread_mutex_unlock(&lock);
	errno = saved;
	return good;
}

int watch_take_written(const struct watch *w, uintptr_t from, uintptr_t end, struct watch *written, int max)
{
	struct scan s = { .flags = SCAN_PROTECT, .category_mask = PAGE_WRITTEN, .return_mask = PAGE_WRITTEN };
	struct scanned pieces[8];
	int saved = errno, n = -1, room = max < 8 ? max : 8;

	if (from < w->first || end > w->end || room < 2 || all.pid != getpid())
		return -1;
	n = scan(&s, from, end, pieces, room - 1);
	errno = saved;
	if (n < 0)
		return -1;
	for (int i = 0; i < n; i++)
		written[i] = (struct watch){ pieces[i].start, pieces[i].end };
	/* No room for more: the rest was not looked at. */
	if (s.walk_end < end)
		written[n++] = (struct watch){ s.walk_end, end };
	return n;
}

void watch_end(struct watch *w)
{
	int saved = errno;

	if (w->end && all.pid == getpid()) {
		pthread_mutex_lock(&lock);
		for (int i = 0; i < MAX_WATCHES; i++)
			if (all.watches[i].first == w->first && all.watches[i].end == w->end)
				all.watches[i] = (struct watch){ 0, 0 };
		forget(w);
		pthread_mutex_unlock(&lock);
	}
	*w = (struct watch){ 0, 0 };
	errno = saved;
}
