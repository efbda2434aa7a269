#include "tracer/hook/host.h"

#include <dlfcn.h>
#include <errno.h>
#include <limits.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/err.h"
#include "kernels/embed.h"

extern char **environ;

/* Text of a kernel source file. */
static const char *text_of(const char *name)
{
	for (size_t i = 0; i < n_kernel_files; i++)
		if (strcmp(kernel_files[i].name, name) == 0)
			return kernel_files[i].text;
	return "";
}

static int write_text(const char *path, const struct hook *hook)
{
	FILE *file = fopen(path, "w");
	int failed = !file || fprintf(file, "#pragma OPENCL FP_CONTRACT OFF\n%s\n%s\n%s\n%s",
	                              text_of("kernels/ref/host_builtins.h"), hook->declarations,
	                              text_of("kernels/ref/hook_host.h"), hook->text) < 0;

	if (file)
		failed |= fclose(file) != 0;
	return failed ? err_report(ERR_SYSTEM, path, "%s", strerror(errno)) : 0;
}

/* Clang by name: other compilers do not accept OpenCL C. */
static int run_clang(const struct hook *hook, const char *source, const char *library)
{
	const char *const words[] = {
		"clang", "-shared", "-fPIC", "-O2", "-ffp-contract=off", "-fno-math-errno", "-x", "cl", "-cl-std=CL1.2",
		"-cl-no-stdinc", "-D__OPENCL_VERSION__=120", "-w", "-o", library, source, "-lm", NULL
	};
	pid_t child;
	int status, code = posix_spawnp(&child, "clang", NULL, NULL, (char *const *)words, environ);

	if (code == 0 && waitpid(child, &status, 0) < 0)
		code = errno;
	if (code == ENOENT || (code == 0 && WIFEXITED(status) && WEXITSTATUS(status) == 127))
		return err_report(ERR_USAGE, NULL,
		                  "the reference device compiles hooks with clang, which is not there; install it or "
		                  "choose an OpenCL device");
	if (code)
		return err_report(ERR_SYSTEM, "clang", "%s", strerror(code));
	return WIFEXITED(status) && WEXITSTATUS(status) == 0 ?
	               0 :
	               err_report(ERR_INPUT, hook->path, "clang refuses this file; its words are above");
}

int hook_compile_host(struct hook *hook)
{
	const char *base = getenv("TMPDIR");
	char folder[PATH_MAX - 16], source[PATH_MAX], library[PATH_MAX];
	int err;

	if (snprintf(folder, sizeof(folder), "%s/relume-hook-XXXXXX", base && *base ? base : "/tmp") >=
	            (int)sizeof(folder) ||
	    !mkdtemp(folder))
		return err_report(ERR_SYSTEM, folder, "%s", strerror(errno));
	snprintf(source, sizeof(source), "%s/hook.cl", folder);
	snprintf(library, sizeof(library), "%s/hook.so", folder);
	err = write_text(source, hook);
	if (!err)
		err = run_clang(hook, source, library);
	if (!err) {
		hook->library = dlopen(library, RTLD_NOW | RTLD_LOCAL);
		if (!hook->library)
			err = err_report(ERR_INPUT, hook->path, "is not whole: %s", dlerror());
	}
	unlink(source);
	unlink(library);
	rmdir(folder);
	return err;
}
