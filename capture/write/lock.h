/*
 * Runs inside the traced program. The writer's lock.
 *
 * While a single thread calls GL, it owns the lock: taking it is a plain store and a load, without an atomic operation.
 * The second thread that calls GL revokes the ownership for good. membarrier makes every thread pass a barrier, so
 * either the owner sees that it no longer owns the lock, or the newcomer sees that the owner is inside.
 */
#pragma once

#include <stdatomic.h>
#include <stdint.h>

#define LOCK_HIDDEN __attribute__((visibility("hidden")))

extern LOCK_HIDDEN _Atomic uint32_t lock_word;
extern LOCK_HIDDEN _Atomic uintptr_t lock_owner; /* address of the owner's lock_is_owner; lock.c has the other values */
extern LOCK_HIDDEN _Atomic int lock_owner_inside;
extern LOCK_HIDDEN __thread int lock_is_owner __attribute__((tls_model("initial-exec"))); /* inside by owning it */

/** The slow path, for threads that do not own the lock. */
void lock_take_shared(void);

/** Called once, inside the lock, by the thread of the first call, which then owns the lock if the kernel allows. */
void lock_choose_owner(void);

/** In the child of a fork: nobody owns the lock. */
void lock_forget_owner(void);

static inline void lock_take(void)
{
	lock_is_owner = 0;
	if (atomic_load_explicit(&lock_owner, memory_order_relaxed) == (uintptr_t)&lock_is_owner) {
		atomic_store_explicit(&lock_owner_inside, 1, memory_order_relaxed);
		atomic_signal_fence(memory_order_seq_cst);
		if (atomic_load_explicit(&lock_owner, memory_order_relaxed) == (uintptr_t)&lock_is_owner) {
			lock_is_owner = 1;
			return;
		}
		atomic_store_explicit(&lock_owner_inside, 0, memory_order_release);
	}
	lock_take_shared();
}

static inline void lock_leave(void)
{
	if (lock_is_owner)
		atomic_store_explicit(&lock_owner_inside, 0, memory_order_release);
	else
		atomic_store_explicit(&lock_word, 0, memory_order_release);
}
