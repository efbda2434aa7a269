/* Runs inside the traced program. */
#include "capture/write/lock.h"

#include <linux/membarrier.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#define NO_OWNER ((uintptr_t)1) /* never again; 0: none yet */

enum { SPINS = 64, NO_MEMBARRIER_US = 20000 };

_Atomic uint32_t lock_word;
_Atomic uintptr_t lock_owner;
_Atomic int lock_owner_inside;
__thread int lock_is_owner __attribute__((tls_model("initial-exec")));

static int membarrier(int command)
{
	return (int)syscall(SYS_membarrier, command, 0, 0);
}

void lock_take_shared(void)
{
	unsigned spins = 0;

	while (atomic_exchange_explicit(&lock_word, 1, memory_order_acquire))
		if (++spins > SPINS)
			sched_yield();
	if (lock_owner > NO_OWNER) {
		lock_owner = NO_OWNER;
		if (membarrier(MEMBARRIER_CMD_PRIVATE_EXPEDITED))
			usleep(NO_MEMBARRIER_US); /* membarrier was forbidden in the meantime: after this time every store has been seen */
		while (atomic_load_explicit(&lock_owner_inside, memory_order_acquire))
			sched_yield();
	}
}

void lock_choose_owner(void)
{
	if (!lock_owner && membarrier(MEMBARRIER_CMD_REGISTER_PRIVATE_EXPEDITED) == 0)
		lock_owner = (uintptr_t)&lock_is_owner;
}

void lock_forget_owner(void)
{
	lock_owner = 0;
}
