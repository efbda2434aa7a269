/*
 * Preloaded into the command by test_confined.py: acts as if a recording had taken over the process. When the command
 * opens a recording or its references, the shim tries what an attacker would, and prints "intruder: WHAT: ERRNO" for
 * each attempt; 0 means success.
 */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

static void tell(const char *what, long result)
{
	fprintf(stderr, "intruder: %s: %d\n", what, result < 0 ? errno : 0);
	if (result > 2)
		close((int)result);
}

static void start_program(void)
{
	int status = 0;
	const pid_t child = fork();

	if (child == 0) {
		execl("/bin/true", "true", (char *)NULL);
		_exit(errno);
	}
	waitpid(child, &status, 0);
	errno = WEXITSTATUS(status);
	tell("exec", errno ? -1 : 0);
}

/* SECRET and VICTIM are files in another folder, NEW does not exist yet, PREY is a process. */
static void intrude(void)
{
	static int done;

	if (done++)
		return;
	tell("read a file", open(getenv("SECRET"), O_RDONLY));
	tell("read accounts", open("/etc/passwd", O_RDONLY));
	tell("overwrite a file", open(getenv("VICTIM"), O_WRONLY));
	tell("truncate a file", truncate(getenv("VICTIM"), 0));
	tell("remove a file", unlink(getenv("VICTIM")));
	tell("make a file", open(getenv("NEW"), O_WRONLY | O_CREAT, 0600));
	tell("list a folder", open(getenv("HOME"), O_RDONLY | O_DIRECTORY));
	tell("socket", socket(AF_INET, SOCK_STREAM, 0));
	tell("local socket", socket(AF_UNIX, SOCK_STREAM, 0));
	tell("io_uring", syscall(SYS_io_uring_setup, 0, NULL) < 0 && errno == EPERM ? -1 : 0);
	tell("kill", kill((pid_t)atol(getenv("PREY")), SIGTERM));
	start_program();
}

static int is_recording(const char *path)
{
	const char *dot = strrchr(path, '.');

	return dot && (strcmp(dot, ".trace") == 0 || strcmp(dot, ".ref") == 0);
}

FILE *fopen(const char *restrict path, const char *restrict mode)
{
	FILE *(*real)(const char *, const char *) = (FILE * (*)(const char *, const char *)) dlsym(RTLD_NEXT, "fopen");
	FILE *file = real(path, mode);

	if (file && *mode == 'r' && is_recording(path))
		intrude();
	return file;
}

FILE *fopen64(const char *restrict path, const char *restrict mode)
{
	return fopen(path, mode);
}
