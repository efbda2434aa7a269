/*
 * Client arrays that stay the same for long and then change in every way that memory can change: by a store, from
 * another thread, by the kernel, by being released, by being remapped, and in a child, whose memory is separate. The
 * replayed recording must show the program's pictures. With an argument an older kernel is simulated, which cannot
 * report stores: the program's descriptors must be unaffected. Run by tests/real/test_record_arrays.sh.
 */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <linux/userfaultfd.h>
#include <pthread.h>
#include <stddef.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "window.h"

enum {
	CELLS = 400,
	CORNERS = 6 * CELLS,
	DRAWS = 10,
	STILL = 9 /* frames between changes: long enough for an array to be trusted */
};
enum { CHANGES = 12, PAGE = 4096 };

static struct corner {
	float position[2], color[3], unused[3];
} *corners;

static size_t bytes_of(void)
{
	return CORNERS * sizeof(struct corner) / PAGE * PAGE + PAGE;
}

static void place(int i)
{
	static const float at[6][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 0 }, { 1, 1 }, { 0, 1 } };
	int cell = i / 6;

	corners[i].position[0] = ((float)(cell % 20) + at[i % 6][0]) / 10 - 1;
	corners[i].position[1] = ((float)(cell / 20) + at[i % 6][1]) / 10 - 1;
}

static void shade(int i, int seed)
{
	for (int k = 0; k < 3; k++)
		corners[i].color[k] = (float)((i / 6 * 37 + seed * 101 + k * 59) % 256) / 255;
}

static void map_anew(int seed)
{
	corners = mmap(corners, bytes_of(), PROT_READ | PROT_WRITE,
	               MAP_PRIVATE | MAP_ANONYMOUS | (corners ? MAP_FIXED : 0), -1, 0);
	expect(corners != MAP_FAILED, "pages");
	for (int i = 0; i < CORNERS; i++) {
		place(i);
		shade(i, seed);
	}
}

static void *store(void *cell)
{
	for (int i = 0; i < 6; i++)
		shade(*(int *)cell * 6 + i, 77);
	return NULL;
}

/* 60 vertices, from the middle of a page to the middle of another. */
static void read_from_kernel(int seed)
{
	struct corner some[60];
	int ends[2];

	memcpy(some, &corners[900], sizeof(some));
	for (int i = 0; i < 60; i++)
		some[i].color[seed % 3] = (float)(i / 6) / 10;
	expect(pipe(ends) == 0 && write(ends[1], some, sizeof(some)) == sizeof(some), "pipe");
	expect(read(ends[0], &corners[900], sizeof(some)) == sizeof(some), "read");
	close(ends[0]);
	close(ends[1]);
}

static void change(int what)
{
	int cell = 30 * what + 7, nothing = 0;
	pthread_t thread;

	switch (what % 6) {
	case 0: /* one number */
		corners[6 * cell + 1].color[0] = 1 - corners[6 * cell + 1].color[0];
		break;
	case 1:
		expect(pthread_create(&thread, NULL, store, &cell) == 0 && pthread_join(thread, NULL) == 0, "thread");
		break;
	case 2:
		read_from_kernel(what);
		break;
	case 3: /* a page of zeros */
		expect(madvise((char *)corners + 5 * PAGE, PAGE, MADV_DONTNEED) == 0, "given back");
		break;
	case 4:
		map_anew(what);
		break;
	default:
		if (fork() == 0) { /* does not change this process' memory */
			shade(3, 99);
			_exit(0);
		}
		wait(&nothing);
	}
}

/* Before Linux 6.7, UFFDIO_API fails when asked to report stores without faults. */
static void use_older_kernel(void)
{
	struct sock_filter rules[] = {
		BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr)),
		BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_ioctl, 0, 3),
		BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, args[1])),
		BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (unsigned)UFFDIO_API, 0, 1),
		BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EINVAL),
		BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
	};
	struct sock_fprog program = { sizeof(rules) / sizeof(rules[0]), rules };

	expect(prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0,
	       "a filter of system calls");
}

/* Descriptors of this process that watch memory. */
static int count_watching(void)
{
	DIR *folder = opendir("/proc/self/fd");
	int n = 0;

	expect(folder != NULL, "/proc/self/fd");
	for (struct dirent *e; (e = readdir(folder));) {
		char to[256] = "";

		if (readlinkat(dirfd(folder), e->d_name, to, sizeof(to) - 1) > 0)
			n += strstr(to, "userfaultfd") || strstr(to, "/pagemap");
	}
	closedir(folder);
	return n;
}

int main(int argc, char **argv)
{
	struct stat input, same;

	(void)argv;
	expect(fstat(0, &input) == 0, "standard input");
	if (argc > 1)
		use_older_kernel();
	open_window();
	map_anew(0);
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_COLOR_ARRAY);
	glVertexPointer(2, GL_FLOAT, sizeof(corners[0]), corners->position);
	glColorPointer(3, GL_FLOAT, sizeof(corners[0]), corners->color);
	for (int frame = 0; frame < CHANGES * STILL; frame++) {
		glClear(GL_COLOR_BUFFER_BIT);
		for (int i = 0; i < DRAWS; i++) {
			if (frame % STILL == STILL - 1 && i == frame / STILL % DRAWS)
				change(frame / STILL);
			glDrawArrays(GL_TRIANGLES, i * CORNERS / DRAWS, CORNERS / DRAWS);
		}
		expect(glGetError() == GL_NO_ERROR, "no error");
		expect(fstat(0, &same) == 0 && same.st_dev == input.st_dev && same.st_ino == input.st_ino,
		       "standard input is unchanged");
		expect(argc == 1 || count_watching() == 0, "unusable descriptors are closed");
		end_frame();
	}
	return 0;
}
