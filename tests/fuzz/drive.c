/*
 * drive replay TARGET FILE...: runs kept inputs (pack_calls.py), one after the other. drive mutate TARGET COUNT SEED
 * FILE...: runs COUNT mutants of the inputs.
 *
 * All libFuzzer targets in one program, without libFuzzer: an input must not crash, take more than 10 s of processor
 * time, or use 1 GiB more than the process started with. A failing input is written to NAME.crash-NUMBER in the current
 * folder. Prints the count like libcheck; exits with 1 if an input failed.
 */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "tests/fuzz/target.h"
#include "tests/fuzz/targets.h"

#define SECONDS 10       /* processor time */
#define MOST_SECONDS 120 /* wall time, in case it waits forever */
#define MEMORY_KB ((long)1 << 20)
#define MOST_INPUTS 65536
#define MOST_BYTES ((size_t)1 << 23)

#define DECLARE(name) \
	int fuzz_##name(const uint8_t *data, size_t size); \
	__attribute__((weak)) int begin_##name(int *argc, char ***argv);
TARGETS(DECLARE)

#define ROW(name) { #name, fuzz_##name, begin_##name },
static const struct target {
	const char *name;
	int (*run)(const uint8_t *data, size_t size);
	int (*begin)(int *argc, char ***argv);
} targets[] = { TARGETS(ROW) };

struct input {
	uint8_t *bytes;
	size_t n;
};
static struct input inputs[MOST_INPUTS];
static size_t n_inputs;

/* Shared memory, where a child reports to its parent. */
static struct progress {
	size_t done; /* inputs that ran to completion */
	int heavy;   /* the next one used too much memory */
} *progress;

static void add_inputs(const char *path)
{
	FILE *file = fopen(path, "rb");
	uint8_t head[4];

	if (!file) {
		perror(path);
		exit(2);
	}
	while (n_inputs < MOST_INPUTS && fread(head, 1, 4, file) == 4) {
		size_t n = head[0] | (size_t)head[1] << 8 | (size_t)head[2] << 16 | (size_t)head[3] << 24;
		uint8_t *bytes = n <= MOST_BYTES ? malloc(n + 1) : NULL;

		if (!bytes || fread(bytes, 1, n, file) != n) {
			fprintf(stderr, "%s is cut\n", path);
			exit(2);
		}
		inputs[n_inputs++] = (struct input){ bytes, n };
	}
	fclose(file);
}

static unsigned draw(unsigned *state, size_t n)
{
	*state = *state * 1664525u + 1013904223u;
	return n ? (*state >> 4) % (unsigned)n : 0;
}

/* As in mutate.py: bytes flipped, set, removed, doubled, spliced; numbers made extreme. @return the new size */
static size_t mutate(uint8_t *data, size_t n, size_t room, unsigned *state)
{
	static const size_t lengths[] = { 1, 2, 8, 100, 5000 };
	static const unsigned rounds[] = { 1, 1, 2, 5, 40 };
	static const uint8_t bytes[] = { 0, 1, 0x7f, 0x80, 0xff };
	static const uint32_t words[] = { 0x7fffffff, 0xffffffff, 0, 0x80808080 };

	for (unsigned k = rounds[draw(state, 5)]; n && k > 0; k--) {
		size_t at = draw(state, n), from = draw(state, n), length = lengths[draw(state, 5)];
		size_t there = length < n - at ? length : n - at, other = length < n - from ? length : n - from;

		switch (draw(state, 6)) {
		case 0: data[at] ^= (uint8_t)(1u << draw(state, 8)); break;
		case 1: data[at] = draw(state, 2) ? bytes[draw(state, 5)] : (uint8_t)draw(state, 256); break;
		case 2:
			memmove(data + at, data + at + there, n - at - there);
			n -= there;
			break;
		case 3:
			other = other < room - n ? other : room - n;
			memmove(data + at + other, data + at, n - at);
			memmove(data + at, data + from, other);
			n += other;
			break;
		case 4: memmove(data + at, data + from, other < n - at ? other : n - at); break;
		default: memcpy(data + at, &words[draw(state, 4)], n - at < 4 ? n - at : 4);
		}
	}
	return n && draw(state, 10) == 0 ? draw(state, n) : n;
}

/* The input with this number: a kept one, or a mutant. */
static size_t make(size_t number, unsigned seed, int mutates, uint8_t *out)
{
	unsigned state = (unsigned)number * 2654435761u + seed;
	const struct input *in = &inputs[mutates ? draw(&state, n_inputs) : number];

	memcpy(out, in->bytes, in->n);
	return mutates ? mutate(out, in->n, MOST_BYTES, &state) : in->n;
}

/* Set limits for an input; 0, 0 ends them. A signal ends the process. */
static void allow(unsigned processor_s, unsigned s)
{
	setitimer(ITIMER_PROF, &(struct itimerval){ .it_value = { .tv_sec = processor_s } }, NULL);
	alarm(s);
}

/* Run in a child until all inputs are done or one fails. */
static void run_from(const struct target *target, size_t first, size_t end, unsigned seed, int mutates, uint8_t *room)
{
	struct rusage usage;
	long base;

	if (!freopen("/dev/null", "w", stdout) || (!getenv("V") && !freopen("/dev/null", "w", stderr)) ||
	    (target->begin && target->begin(NULL, NULL)))
		_exit(2);
	getrusage(RUSAGE_SELF, &usage);
	base = usage.ru_maxrss;
	for (size_t i = first; i < end; i++) {
		size_t n = make(i, seed, mutates, room);

		allow(SECONDS, MOST_SECONDS);
		target->run(room, n);
		allow(0, 0);
		getrusage(RUSAGE_SELF, &usage);
		progress->heavy = usage.ru_maxrss > base + MEMORY_KB;
		if (progress->heavy) {
			target_end();
			_exit(1);
		}
		progress->done = i + 1;
	}
	target_end();
	_exit(0); /* at exit, a library used by OpenImageIO waits for a thread that a fork lacks */
}

static void keep(const char *name, size_t number, const uint8_t *bytes, size_t n, int status)
{
	char path[128];
	FILE *file;

	snprintf(path, sizeof(path), "%s.crash-%zu", name, number);
	file = fopen(path, "wb");
	if (file) {
		fwrite(bytes, 1, n, file);
		fclose(file);
	}
	if (progress->heavy)
		printf("%s: input %zu takes more than 1 GiB (%s)\n", name, number, path);
	else if (WIFSIGNALED(status))
		printf("%s: input %zu: %s (%s)\n", name, number,
		       WTERMSIG(status) == SIGALRM || WTERMSIG(status) == SIGPROF ? "no end" :
		                                                                    strsignal(WTERMSIG(status)),
		       path);
	else
		printf("%s: input %zu: exit code %d (%s)\n", name, number, WEXITSTATUS(status), path);
}

static size_t run_all(const struct target *target, size_t count, unsigned seed, int mutates)
{
	uint8_t *room = malloc(MOST_BYTES);
	size_t first = 0, broken = 0;

	if (!room)
		return count;
	while (first < count) {
		int status = 0;
		pid_t child;

		progress->done = first;
		progress->heavy = 0;
		fflush(stdout);
		child = fork();
		if (child == 0)
			run_from(target, first, count, seed, mutates, room);
		if (child < 0 || waitpid(child, &status, 0) != child)
			return count;
		first = progress->done;
		if (first < count) { /* it ended early */
			size_t n = make(first, seed, mutates, room);

			keep(target->name, first++, room, n, status);
			broken++;
		}
	}
	free(room);
	return broken;
}

int main(int argc, char **argv)
{
	const struct target *target = NULL;
	const int mutates = argc > 1 && strcmp(argv[1], "mutate") == 0;
	size_t count, broken;

	for (size_t i = 0; argc > 2 && i < sizeof(targets) / sizeof(targets[0]); i++)
		if (strcmp(targets[i].name, argv[2]) == 0)
			target = &targets[i];
	if (!target || argc < (mutates ? 6 : 4)) {
		fprintf(stderr, "usage: drive replay TARGET FILE...\n       drive mutate TARGET COUNT SEED FILE...\n");
		return 2;
	}
	for (int i = mutates ? 5 : 3; i < argc; i++)
		add_inputs(argv[i]);
	progress = mmap(NULL, sizeof(*progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
	if (!n_inputs || progress == MAP_FAILED)
		return 2;
	count = mutates ? strtoul(argv[3], NULL, 10) : n_inputs;
	broken = run_all(target, count, mutates ? (unsigned)strtoul(argv[4], NULL, 10) : 0, mutates);
	printf("%zu%%: Checks: %zu, Failures: %zu, Errors: 0\n", 100 * (count - broken) / count, count, broken);
	return broken != 0;
}
