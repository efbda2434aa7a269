/*
 * Hides AVX-512. Preloaded, it makes CPUID report a Haswell, so that PoCL compiles kernels as on a Haswell, whatever
 * LLVM version it contains. The processor faults on CPUID (arch_prctl(2), ARCH_SET_CPUID), and a handler supplies the
 * answer. If the processor cannot do that, the program exits with code 77. Give PoCL a separate POCL_CACHE_DIR: version
 * 3.1 distinguishes processors only by name.
 */
#include <asm/prctl.h>
#include <cpuid.h>
#include <dlfcn.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#define HASWELL 0x306c3u /* family, model and stepping: Intel's manual, volume 2, CPUID leaf 1 */

/* Bits of leaf 7 for AVX-512 and its later extensions. */
#define LEAF7_EBX (1u << 16 | 1u << 17 | 1u << 21 | 1u << 26 | 1u << 27 | 1u << 28 | 1u << 30 | 1u << 31)
#define LEAF7_ECX (1u << 1 | 1u << 6 | 1u << 11 | 1u << 12 | 1u << 14)
#define LEAF7_EDX (1u << 2 | 1u << 3 | 1u << 8 | 1u << 23)
#define LEAF7_1_EAX (1u << 5)
#define LEAF7_1_EDX (1u << 19)

static struct sigaction others; /* handler for all other faults */

typedef int set_function(int, const struct sigaction *, struct sigaction *);

static int set_action(int number, const struct sigaction *action, struct sigaction *before)
{
	return ((set_function *)dlsym(RTLD_NEXT, "sigaction"))(number, action, before);
}

/* LLVM installs a handler of its own while it writes files. */
int sigaction(int number, const struct sigaction *action, struct sigaction *before)
{
	const struct sigaction was = others;

	if (number != SIGSEGV)
		return set_action(number, action, before);
	if (action)
		others = *action;
	if (before)
		*before = was;
	return 0;
}

static void answer(uint32_t leaf, uint32_t part, uint32_t out[4])
{
	syscall(SYS_arch_prctl, ARCH_SET_CPUID, 1);
	__cpuid_count(leaf, part, out[0], out[1], out[2], out[3]);
	syscall(SYS_arch_prctl, ARCH_SET_CPUID, 0);
	if (leaf == 1)
		out[0] = HASWELL;
	if (leaf == 7 && part == 0) {
		out[1] &= ~LEAF7_EBX;
		out[2] &= ~LEAF7_ECX;
		out[3] &= ~LEAF7_EDX;
	}
	if (leaf == 7 && part == 1) {
		out[0] &= ~LEAF7_1_EAX;
		out[3] &= ~LEAF7_1_EDX;
	}
}

static void on_fault(int number, siginfo_t *info, void *context)
{
	greg_t *registers = ((ucontext_t *)context)->uc_mcontext.gregs;
	const unsigned char *at = (const unsigned char *)registers[REG_RIP];
	uint32_t out[4];

	/* A fault with an address has another cause. Do not read code beyond the end of its page. */
	if (info->si_code != SI_KERNEL || at[0] != 0x0f || at[1] != 0xa2) {
		set_action(number, &others, NULL);
		return;
	}
	answer((uint32_t)registers[REG_RAX], (uint32_t)registers[REG_RCX], out);
	registers[REG_RAX] = out[0];
	registers[REG_RBX] = out[1];
	registers[REG_RCX] = out[2];
	registers[REG_RDX] = out[3];
	registers[REG_RIP] += 2;
}

__attribute__((constructor)) static void hide(void)
{
	const struct sigaction ours = { .sa_sigaction = on_fault, .sa_flags = SA_SIGINFO | SA_NODEFER };

	set_action(SIGSEGV, &ours, &others);
	if (syscall(SYS_arch_prctl, ARCH_SET_CPUID, 0)) {
		fputs("avx2_shim: this processor cannot hide AVX-512 (no cpuid_fault in /proc/cpuinfo)\n", stderr);
		_exit(77);
	}
}
