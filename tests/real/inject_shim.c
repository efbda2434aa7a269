/*
 * Preloaded: makes system calls fail. INJECT="CLASS:N" fails the Nth call of a class (from 1) that the command or
 * recorder makes itself, "CLASS:N+" that call and all later ones, "CLASS@N:M" the Mth call from the Nth call site of
 * the class, and "CLASS@N+" all calls from that site. Calls that libraries make for themselves are unaffected. When a
 * process ends, the file named by INJECT_COUNT receives lines "CLASS COUNT" and "CLASS@N COUNT" for each class and
 * site.
 *
 * Memory comes from the next library that provides it: LeakSanitizer's, if that is preloaded after this one.
 * INJECT_SPARED holds its suppressions, since a confined command cannot read them from a file.
 */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <link.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

enum class { MEMORY, READ, WRITE, MAP, OPEN, THREAD, N_CLASSES };
static const char *const names[N_CLASSES] = { "malloc", "read", "write", "mmap", "open", "thread" };
static const int errors[N_CLASSES] = { ENOMEM, EIO, ENOSPC, ENOMEM, EMFILE, EAGAIN };

static atomic_ulong counts[N_CLASSES];
static enum class failing = N_CLASSES;
static unsigned long from, from_there = 1;
static int and_on, by_place, count_fd = -1;
enum { MOST_PLACES = 1024 };
static atomic_uintptr_t places[N_CLASSES][MOST_PLACES]; /* in the order of their first calls */
static atomic_ulong place_counts[N_CLASSES][MOST_PLACES];
static uintptr_t ranges[4][2];
static int n_ranges;

static int take_range(struct dl_phdr_info *info, size_t size, void *first)
{
	char own[4096];
	const ssize_t n = readlink("/proc/self/exe", own, sizeof(own) - 1);
	const int is_own = !(*(int *)first)++ && n > 7 && memcmp(own + n - 7, "/relume", 7) == 0;

	(void)size;
	if (!is_own && !strstr(info->dlpi_name, "librelume.so"))
		return 0;
	for (int i = 0; i < info->dlpi_phnum && n_ranges < 4; i++)
		if (info->dlpi_phdr[i].p_type == PT_LOAD && info->dlpi_phdr[i].p_flags & PF_X) {
			ranges[n_ranges][0] = info->dlpi_addr + info->dlpi_phdr[i].p_vaddr;
			ranges[n_ranges][1] = ranges[n_ranges][0] + info->dlpi_phdr[i].p_memsz;
			n_ranges++;
		}
	return 0;
}

/* LeakSanitizer's queries: the suppressions, and whether to skip leak checks (a linker started by a driver is not
 * ours). */
const char *__lsan_default_suppressions(void);
int __lsan_is_turned_off(void);

const char *__lsan_default_suppressions(void)
{
	const char *text = getenv("INJECT_SPARED");

	return text ? text : "";
}

int __lsan_is_turned_off(void) { return !n_ranges; }

static void begin(void) __attribute__((constructor));
static void begin(void)
{
	const char *text = getenv("INJECT"), *path = getenv("INJECT_COUNT");
	int first = 0;

	if (path)
		count_fd = open(path, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
	dl_iterate_phdr(take_range, &first);
	for (int c = 0; text && c < N_CLASSES; c++)
		if (strncmp(text, names[c], strlen(names[c])) == 0 && strchr(":@", text[strlen(names[c])])) {
			char *end;

			by_place = text[strlen(names[c])] == '@';
			from = strtoul(text + strlen(names[c]) + 1, &end, 10);
			if (by_place && *end == ':')
				from_there = strtoul(end + 1, &end, 10);
			and_on = *end == '+';
			failing = (enum class)c;
		}
}

static void end(void) __attribute__((destructor));
static void end(void)
{
	char text[64];

	for (int c = 0; count_fd >= 0 && n_ranges && c < N_CLASSES; c++) {
		int n = snprintf(text, sizeof(text), "%s %lu\n", names[c], atomic_load(&counts[c])),
		    ok = write(count_fd, text, (size_t)n) == n;

		for (int i = 0; ok && i < MOST_PLACES && atomic_load(&places[c][i]); i++) {
			n = snprintf(text, sizeof(text), "%s@%d %lu\n", names[c], i + 1, atomic_load(&place_counts[c][i]));
			ok = write(count_fd, text, (size_t)n) == n;
		}
	}
}

/* Forked processes end here. */
void _exit(int code)
{
	end();
	((__typeof__(&_exit))dlsym(RTLD_NEXT, "_exit"))(code);
	__builtin_unreachable();
}

/* Number of a call site, in the order of first calls. nth: receives the count of calls from that site */
static unsigned long number_place(enum class class, uintptr_t at, unsigned long *nth)
{
	for (unsigned long i = 0; i < MOST_PLACES; i++) {
		uintptr_t other = 0;

		if (atomic_compare_exchange_strong(&places[class][i], &other, at) || other == at) {
			*nth = atomic_fetch_add(&place_counts[class][i], 1) + 1;
			return i + 1;
		}
	}
	return 0;
}

/* Whether this call fails. by: its return address */
static int fails(enum class class, const void *by)
{
	const uintptr_t at = (uintptr_t)by;
	unsigned long number = 0, place = 0, nth = 0;

	for (int i = 0; i < n_ranges; i++)
		if (at >= ranges[i][0] && at < ranges[i][1]) {
			number = atomic_fetch_add(&counts[class], 1) + 1;
			place = number_place(class, at, &nth);
		}
	if (!number || class != failing)
		return 0;
	if (by_place ? place != from || (!and_on && nth != from_there) : number != from && !(and_on && number > from))
		return 0;
	errno = errors[class];
	return 1;
}

#define BY __builtin_return_address(0)
#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

/* Looked up once, because memory is requested often. */
static __typeof__(&malloc) next_malloc;
static __typeof__(&calloc) next_calloc;
static __typeof__(&realloc) next_realloc;
static __typeof__(&aligned_alloc) next_aligned_alloc;
static void find_next(void)
{
	if (next_aligned_alloc)
		return;
	next_malloc = REAL(malloc);
	next_calloc = REAL(calloc);
	next_realloc = REAL(realloc);
	next_aligned_alloc = REAL(aligned_alloc);
}
#define NEXT(name) (find_next(), next_##name)

void *malloc(size_t n) { return fails(MEMORY, BY) ? NULL : NEXT(malloc)(n); }
void *calloc(size_t n, size_t size) { return fails(MEMORY, BY) ? NULL : NEXT(calloc)(n, size); }
void *realloc(void *p, size_t n) { return fails(MEMORY, BY) ? NULL : NEXT(realloc)(p, n); }
void *aligned_alloc(size_t to, size_t n) { return fails(MEMORY, BY) ? NULL : NEXT(aligned_alloc)(to, n); }
char *strdup(const char *text)
{
	const size_t n = strlen(text) + 1;
	char *out = fails(MEMORY, BY) ? NULL : NEXT(malloc)(n);

	return out ? memcpy(out, text, n) : NULL;
}
int vasprintf(char **out, const char *format, va_list args)
{
	return fails(MEMORY, BY) ? -1 : REAL(vasprintf)(out, format, args);
}
int asprintf(char **out, const char *format, ...)
{
	va_list args;
	int n;

	if (fails(MEMORY, BY))
		return -1;
	va_start(args, format);
	n = REAL(vasprintf)(out, format, args);
	va_end(args);
	return n;
}
FILE *open_memstream(char **out, size_t *n) { return fails(MEMORY, BY) ? NULL : REAL(open_memstream)(out, n); }

ssize_t read(int fd, void *to, size_t n) { return fails(READ, BY) ? -1 : REAL(read)(fd, to, n); }
ssize_t pread(int fd, void *to, size_t n, off_t at) { return fails(READ, BY) ? -1 : REAL(pread)(fd, to, n, at); }

/* A failed stream keeps its error state, as with the real fread. */
size_t fread(void *to, size_t size, size_t n, FILE *f)
{
	if (!fails(READ, BY))
		return REAL(fread)(to, size, n, f);
	f->_flags |= 0x20; /* glibc's _IO_ERR_SEEN */
	errno = EIO;
	return 0;
}

ssize_t write(int fd, const void *from_, size_t n)
{
	return fd != 2 && fails(WRITE, BY) ? -1 : REAL(write)(fd, from_, n);
}
ssize_t pwrite(int fd, const void *from_, size_t n, off_t at)
{
	return fails(WRITE, BY) ? -1 : REAL(pwrite)(fd, from_, n, at);
}

static int is_file(FILE *f) { return fileno(f) >= 0 && fileno(f) != 2; }
size_t fwrite(const void *from_, size_t size, size_t n, FILE *f)
{
	if (!is_file(f) || !fails(WRITE, BY))
		return REAL(fwrite)(from_, size, n, f);
	f->_flags |= 0x20;
	errno = ENOSPC;
	return 0;
}
int fflush(FILE *f) { return f && is_file(f) && fails(WRITE, BY) ? EOF : REAL(fflush)(f); }
int fclose(FILE *f)
{
	const int failed = is_file(f) && fails(WRITE, BY), done = REAL(fclose)(f);

	if (failed)
		errno = ENOSPC;
	return failed ? EOF : done;
}

void *mmap(void *at, size_t n, int rights, int flags, int fd, off_t offset)
{
	return fails(MAP, BY) ? MAP_FAILED : REAL(mmap)(at, n, rights, flags, fd, offset);
}
int ftruncate(int fd, off_t n) { return fails(MAP, BY) ? -1 : REAL(ftruncate)(fd, n); }

int open(const char *path, int flags, ...)
{
	va_list args;
	mode_t mode;

	va_start(args, flags);
	mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(args, mode_t) : 0;
	va_end(args);
	return fails(OPEN, BY) ? -1 : REAL(open)(path, flags, mode);
}
FILE *fopen(const char *path, const char *mode) { return fails(OPEN, BY) ? NULL : REAL(fopen)(path, mode); }
int rename(const char *from_, const char *to) { return fails(OPEN, BY) ? -1 : REAL(rename)(from_, to); }
int mkdir(const char *path, mode_t mode) { return fails(OPEN, BY) ? -1 : REAL(mkdir)(path, mode); }
int memfd_create(const char *name, unsigned flags) { return fails(OPEN, BY) ? -1 : REAL(memfd_create)(name, flags); }

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *user)
{
	return fails(THREAD, BY) ? EAGAIN : REAL(pthread_create)(thread, attributes, run, user);
}
