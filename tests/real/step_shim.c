/*
 * Preloaded into `relume ci`: if the folder holds a file called "renderer", runs the program that STEP names instead of
 * `relume render` and `relume diff`, with their command line as its arguments. A test can thus break a step without
 * breaking the command.
 */
#include <dlfcn.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int posix_spawnp(pid_t *pid, const char *file, const posix_spawn_file_actions_t *actions,
                 const posix_spawnattr_t *attributes, char *const argv[], char *const envp[])
{
	int (*real)(pid_t *, const char *, const posix_spawn_file_actions_t *, const posix_spawnattr_t *, char *const[],
	            char *const[]);
	char *step = getenv("STEP"), **words;
	size_t n = 0;
	int code;

	*(void **)&real = dlsym(RTLD_NEXT, "posix_spawnp");
	while (argv[n])
		n++;
	if (!step || n < 2 || (strcmp(argv[1], "render") != 0 && strcmp(argv[1], "diff") != 0) || access("renderer", F_OK))
		return real(pid, file, actions, attributes, argv, envp);
	words = calloc(n + 2, sizeof(*words));
	words[0] = step;
	memcpy(words + 1, argv, n * sizeof(*words));
	code = real(pid, step, actions, attributes, words, envp);
	free(words);
	return code;
}
