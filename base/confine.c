#include "base/confine.h"

#include <errno.h>
#include <fcntl.h>
#include <glob.h>
#include <limits.h>
#include <linux/landlock.h>
#include <seccomp.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "base/caches.h"
#include "base/err.h"
#include "base/folder.h"

/* From Linux 6.2, newer than Debian 12's headers. */
#ifndef LANDLOCK_ACCESS_FS_TRUNCATE
#define LANDLOCK_ACCESS_FS_TRUNCATE (1u << 14)
#endif

/* Landlock rights. A right that is handled but not granted is refused. */
enum {
	READ_FILES = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR,
	MAKE_FILES = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_REMOVE_FILE |
	             LANDLOCK_ACCESS_FS_TRUNCATE,
	ALL_IN_FOLDER = READ_FILES | MAKE_FILES | LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_REMOVE_DIR |
	                LANDLOCK_ACCESS_FS_REFER,
	OF_FILES = LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_READ_FILE |
	           LANDLOCK_ACCESS_FS_TRUNCATE,
	FIRST_VERSION = 2 * LANDLOCK_ACCESS_FS_MAKE_SYM - 1
};

struct sandbox {
	int ruleset;
	uint32_t handled;
	int err; /* 0 or ERR_SYSTEM (reported) */
};

/* --- Files ------------------------------------------------------------------------------------------------------- */

/* Skips files that are missing or may not be opened. Libraries crash if a file they rely on exists but is refused. */
static void grant(struct sandbox *s, const char *path, uint32_t rights)
{
	struct landlock_path_beneath_attr rule = { .parent_fd = open(path, O_PATH | O_CLOEXEC) };
	struct stat st;

	if (rule.parent_fd < 0) {
		if (!s->err && (errno == EMFILE || errno == ENFILE || errno == ENOMEM))
			s->err = err_report(ERR_SYSTEM, path, "cannot be kept while files are confined: %s", strerror(errno));
		return;
	}
	if (fstat(rule.parent_fd, &st) == 0) {
		rule.allowed_access = rights & s->handled & (S_ISDIR(st.st_mode) ? ~0u : OF_FILES);
		syscall(SYS_landlock_add_rule, s->ruleset, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
	}
	close(rule.parent_fd);
}

static void grant_folder_of(struct sandbox *s, const char *file, uint32_t rights)
{
	const char *slash = strrchr(file, '/');
	char folder[PATH_MAX];

	if (!slash)
		grant(s, ".", rights);
	else if (snprintf(folder, sizeof(folder), "%.*s", slash == file ? 1 : (int)(slash - file), file) < (int)sizeof(folder))
		grant(s, folder, rights);
}

/* Beside NAME.trace: NAME.ref, and NAME.trace.index, which is rebuilt if missing or older than recording or program. */
static void grant_beside(struct sandbox *s, const char *trace)
{
	const char *dot = strrchr(trace, '.');
	struct stat recording, index, own;
	char name[PATH_MAX];

	if (dot && snprintf(name, sizeof(name), "%.*s.ref", (int)(dot - trace), trace) < (int)sizeof(name))
		grant(s, name, READ_FILES);
	if (stat(trace, &recording) || !S_ISREG(recording.st_mode) ||
	    snprintf(name, sizeof(name), "%s.index", trace) >= (int)sizeof(name))
		return;
	if (stat(name, &index) == 0 && index.st_mtime >= recording.st_mtime && stat("/proc/self/exe", &own) == 0 &&
	    index.st_mtime >= own.st_mtime)
		grant(s, name, READ_FILES);
	else
		grant_folder_of(s, trace, ALL_IN_FOLDER);
}

/* An output folder, made now if it is missing: Landlock can only grant files that exist. */
static void grant_made(struct sandbox *s, const char *folder, int is_cache)
{
	char parent[PATH_MAX];

	if (access(folder, F_OK) != 0 && folder_nearest(folder, parent, sizeof(parent)))
		grant(s, parent, LANDLOCK_ACCESS_FS_REMOVE_DIR);
	if (!folder_try_early(folder, is_cache))
		grant(s, folder, ALL_IN_FOLDER);
}

/* is_dry: 1: nothing is written */
static void grant_file(struct sandbox *s, const struct confine_file *file, int is_dry)
{
	const int is_there = access(file->path, F_OK) == 0;
	const char *slash = strrchr(file->path, '/');
	char folder[PATH_MAX];

	if (strcmp(file->path, "-") == 0)
		return;
	switch (file->use) {
	case CONFINE_READS:
	case CONFINE_RECORDING:
		if (is_there)
			grant(s, file->path, READ_FILES);
		else
			grant_folder_of(s, file->path, READ_FILES);
		if (is_there && file->use == CONFINE_RECORDING)
			grant_beside(s, file->path);
		break;
	case CONFINE_MAKES:
		if (slash && !is_dry &&
		    snprintf(folder, sizeof(folder), "%.*s", (int)(slash - file->path), file->path) <
		            (int)sizeof(folder))
			grant_made(s, folder, 0);
		/* fall through */
	case CONFINE_WRITES: grant_folder_of(s, file->path, ALL_IN_FOLDER); break;
	case CONFINE_FILLS: grant_made(s, file->path, 0); break;
	case CONFINE_UNUSED:
	case CONFINE_DRY: break;
	}
}

/* The folders in a list like PATH, and those that links in them point to. */
static void grant_list(struct sandbox *s, const char *list)
{
	char *copy = list ? strdup(list) : NULL, *rest = copy;

	for (char *word = strsep(&rest, ": "); word; word = strsep(&rest, ": ")) {
		char pattern[PATH_MAX], real[PATH_MAX];
		glob_t found;

		grant(s, word, READ_FILES);
		if (snprintf(pattern, sizeof(pattern), "%s/*.so*", word) >= (int)sizeof(pattern) ||
		    glob(pattern, GLOB_NOSORT, NULL, &found))
			continue;
		for (size_t i = 0; i < found.gl_pathc; i++)
			if (realpath(found.gl_pathv[i], real) && strcmp(real, found.gl_pathv[i]) != 0)
				grant_folder_of(s, real, READ_FILES);
		globfree(&found);
	}
	free(copy);
}

/* Files that every process reads: libraries, their settings, system information. */
static void grant_system(struct sandbox *s)
{
	static const char *const reads[] = {
		"/usr", "/lib", "/lib64", "/opt", "/etc/ld.so.cache", "/etc/ld.so.conf", "/etc/ld.so.conf.d",
		"/etc/alternatives", "/etc/localtime", "/etc/locale.alias", "/etc/debian_version", "/etc/os-release",
		"/etc/OpenCL", "/proc/self", "/proc/cpuinfo", "/proc/meminfo", "/proc/stat", "/proc/filesystems", "/sys"
	};
	static const char *const devices[] = { "/dev/null", "/dev/zero", "/dev/full", "/dev/urandom", "/dev/random" };
	char own[PATH_MAX];
	const ssize_t n = readlink("/proc/self/exe", own, sizeof(own) - 1);

	for (size_t i = 0; i < sizeof(reads) / sizeof(reads[0]); i++)
		grant(s, reads[i], READ_FILES);
	for (size_t i = 0; i < sizeof(devices) / sizeof(devices[0]); i++)
		grant(s, devices[i], READ_FILES | LANDLOCK_ACCESS_FS_WRITE_FILE);
	own[n > 0 ? n : 0] = '\0';
	grant(s, own, READ_FILES);
	grant_folder_of(s, own, READ_FILES);
	grant_list(s, getenv("LD_LIBRARY_PATH"));
	grant_list(s, getenv("LD_PRELOAD"));
}

/* --- OpenCL ------------------------------------------------------------------------------------------------------ */

/* A folder in the user's caches, or the one named by the implementation's own variable. */
static void grant_cache(struct sandbox *s, const char *variable, const char *name, int make)
{
	const char *said = getenv(variable), *caches = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
	char path[PATH_MAX];
	int n;

	if (said && *said)
		n = snprintf(path, sizeof(path), "%s", said);
	else if (caches && *caches)
		n = snprintf(path, sizeof(path), "%s/%s", caches, name);
	else
		n = snprintf(path, sizeof(path), "%s/.cache/%s", home ? home : "", name);
	if (n < (int)sizeof(path) && make)
		grant_made(s, path, 1);
	else if (n < (int)sizeof(path))
		grant(s, path, ALL_IN_FOLDER);
}

/* The folders of the libraries named by a folder's *.icd files. */
static void grant_vendors(struct sandbox *s, const char *folder)
{
	char pattern[PATH_MAX], library[PATH_MAX], real[PATH_MAX];
	glob_t found;

	if (!folder || snprintf(pattern, sizeof(pattern), "%s/*.icd", folder) >= (int)sizeof(pattern) ||
	    glob(pattern, 0, NULL, &found))
		return;
	grant(s, folder, READ_FILES);
	for (size_t i = 0; i < found.gl_pathc; i++) {
		FILE *file = fopen(found.gl_pathv[i], "r");

		if (file && fscanf(file, "%4095s", library) == 1 && realpath(library, real))
			grant_folder_of(s, real, READ_FILES);
		if (file)
			fclose(file);
	}
	globfree(&found);
}

/* PoCL links kernels with ld. To start a program, both its file and its loader must be executable. */
static void grant_linker(struct sandbox *s)
{
	static const char *const programs[] = { "/usr/bin/ld", "/usr/bin/ld.bfd", "/usr/bin/ld.lld",
		                                "/lib64/ld-linux-x86-64.so.2", "/lib/ld-linux-aarch64.so.1" };

	for (size_t i = 0; i < sizeof(programs) / sizeof(programs[0]); i++)
		grant(s, programs[i], LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_READ_FILE);
}

/*
 * NVIDIA's driver caches the machine code that it compiles from our kept kernels; without the cache each run takes 20 s
 * longer. It ignores XDG_CACHE_HOME.
 */
static void grant_nvidia(struct sandbox *s)
{
	const char *said = getenv("CUDA_CACHE_PATH"), *home = getenv("HOME");
	char path[PATH_MAX];

	if (access("/dev/nvidiactl", F_OK) == 0 && snprintf(path, sizeof(path), "%s%s",
	                                                    said && *said ? said :
	                                                    home          ? home :
	                                                                    "",
	                                                    said && *said ? "" : "/.nv") < (int)sizeof(path))
		grant_made(s, path, 1);
}

static void grant_devices(struct sandbox *s)
{
	static const char *const patterns[] = { "/dev/nvidia*", "/dev/dri", "/dev/kfd", "/dev/shm", "/dev/accel" };
	glob_t found;

	for (size_t i = 0; i < sizeof(patterns) / sizeof(patterns[0]); i++) {
		if (glob(patterns[i], GLOB_NOSORT, NULL, &found))
			continue;
		for (size_t k = 0; k < found.gl_pathc; k++)
			grant(s, found.gl_pathv[k], READ_FILES | MAKE_FILES);
		globfree(&found);
	}
	grant(s, "/proc/driver", READ_FILES);
	grant_vendors(s, "/etc/OpenCL/vendors");
	grant_vendors(s, getenv("OCL_ICD_VENDORS"));
	grant_vendors(s, getenv("OPENCL_VENDOR_PATH"));
	grant_cache(s, "POCL_CACHE_DIR", "pocl", 1);
	grant_cache(s, "NEO_CACHE_DIR", "neo_compiler_cache", 0);
	grant_cache(s, "MESA_SHADER_CACHE_DIR", "mesa_shader_cache", 0);
	grant_nvidia(s);
	grant_linker(s);
}

/* --- Calls ------------------------------------------------------------------------------------------------------- */

/* Networks, other processes, the system, and file operations other than reading and writing. */
static const int refused[] = {
	SCMP_SYS(socket), SCMP_SYS(connect), SCMP_SYS(bind), SCMP_SYS(listen), SCMP_SYS(accept), SCMP_SYS(accept4),
	SCMP_SYS(io_uring_setup), SCMP_SYS(tkill), SCMP_SYS(pidfd_send_signal), SCMP_SYS(rt_sigqueueinfo),
	SCMP_SYS(rt_tgsigqueueinfo), SCMP_SYS(pidfd_getfd), SCMP_SYS(setns), SCMP_SYS(unshare), SCMP_SYS(mount),
	SCMP_SYS(umount2), SCMP_SYS(pivot_root), SCMP_SYS(chroot), SCMP_SYS(move_mount), SCMP_SYS(open_by_handle_at),
	SCMP_SYS(keyctl), SCMP_SYS(add_key), SCMP_SYS(request_key), SCMP_SYS(bpf), SCMP_SYS(perf_event_open),
	SCMP_SYS(userfaultfd), SCMP_SYS(init_module), SCMP_SYS(finit_module), SCMP_SYS(delete_module), SCMP_SYS(kexec_load),
	SCMP_SYS(reboot), SCMP_SYS(swapon), SCMP_SYS(swapoff), SCMP_SYS(settimeofday), SCMP_SYS(clock_settime),
	SCMP_SYS(clock_adjtime), SCMP_SYS(adjtimex), SCMP_SYS(chown), SCMP_SYS(lchown), SCMP_SYS(fchownat),
	SCMP_SYS(setxattr), SCMP_SYS(lsetxattr), SCMP_SYS(removexattr), SCMP_SYS(lremovexattr), SCMP_SYS(mknod),
	SCMP_SYS(mknodat)
};

/* @return 0, or an errno below 0 */
static int refuse_calls(enum confine_kind kind)
{
	scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
	const uint32_t no = SCMP_ACT_ERRNO(EPERM);
	int err;

	if (!filter)
		return -ENOMEM;
	for (size_t i = 0; i < sizeof(refused) / sizeof(refused[0]); i++)
		seccomp_rule_add(filter, no, refused[i], 0);
	if (kind != CONFINE_TRACER) {
		seccomp_rule_add(filter, no, SCMP_SYS(execve), 0);
		seccomp_rule_add(filter, no, SCMP_SYS(execveat), 0);
	}
	/* ld fails if it cannot make a library executable, which is not needed: these calls report success and do nothing. */
	seccomp_rule_add(filter, SCMP_ACT_ERRNO(0), SCMP_SYS(chmod), 0);
	seccomp_rule_add(filter, SCMP_ACT_ERRNO(0), SCMP_SYS(fchmodat), 0);
	/*
	 * Signal 0 asks whether a process runs (base/part.c). Signals to threads of this process are allowed; pushing input
	 * into a terminal is not.
	 */
	seccomp_rule_add(filter, no, SCMP_SYS(kill), 1, SCMP_A1(SCMP_CMP_NE, 0));
	seccomp_rule_add(filter, no, SCMP_SYS(tgkill), 1, SCMP_A0(SCMP_CMP_NE, (scmp_datum_t)getpid()));
	seccomp_rule_add(filter, no, SCMP_SYS(ioctl), 1, SCMP_A1(SCMP_CMP_MASKED_EQ, UINT32_MAX, TIOCSTI));
	seccomp_rule_add(filter, no, SCMP_SYS(ioctl), 1, SCMP_A1(SCMP_CMP_MASKED_EQ, UINT32_MAX, TIOCLINUX));
	seccomp_attr_set(filter, SCMP_FLTATR_CTL_TSYNC, 1);
	err = seccomp_load(filter);
	seccomp_release(filter);
	return err;
}

/* --- All of it --------------------------------------------------------------------------------------------------- */

/* @return 0; 1: this kernel has no Landlock */
static int begin(struct sandbox *s)
{
	const long version = syscall(SYS_landlock_create_ruleset, NULL, 0, LANDLOCK_CREATE_RULESET_VERSION);
	struct landlock_ruleset_attr attr;

	if (version < 1)
		return 1;
	s->handled = FIRST_VERSION | (version >= 2 ? LANDLOCK_ACCESS_FS_REFER : 0) |
	             (version >= 3 ? LANDLOCK_ACCESS_FS_TRUNCATE : 0);
	attr = (struct landlock_ruleset_attr){ .handled_access_fs = s->handled };
	s->ruleset = (int)syscall(SYS_landlock_create_ruleset, &attr, sizeof(attr), 0);
	return s->ruleset < 0;
}

int confine_to(const struct confine_file *files, size_t n, enum confine_kind kind)
{
	struct sandbox s = { .ruleset = -1 };
	char own[PATH_MAX];
	int is_dry = 0, refuses;

	if (kind == CONFINE_TRACER)
		caches_find();
	for (size_t i = 0; i < n; i++)
		is_dry |= files[i].use == CONFINE_DRY;
	if (begin(&s)) {
		err_warn(NULL, "this kernel has no Landlock: what reads the recording could open any file");
	} else {
		grant_system(&s);
		if (kind == CONFINE_TRACER)
			grant_devices(&s);
		if (folder_cached("", own, sizeof(own)))
			grant_made(&s, own, 1);
		for (size_t i = 0; i < n; i++)
			grant_file(&s, &files[i], is_dry);
	}
	if (s.err)
		goto done;
	if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && s.ruleset >= 0 &&
	    syscall(SYS_landlock_restrict_self, s.ruleset, 0) != 0)
		err_warn(NULL, "files cannot be confined: %s", strerror(errno));
	refuses = refuse_calls(kind);
	if (refuses)
		err_warn(NULL, "calls cannot be confined: %s", strerror(-refuses));
done:
	if (s.ruleset >= 0)
		close(s.ruleset);
	return s.err;
}
