/*
 * A processor without AVX-512: preloaded, it has PoCL's LLVM 15 answer that this machine is a Haswell, so that PoCL compiles kernels as
 * it does there. POCL_CACHE_DIR must be another one than PoCL uses otherwise: its cache knows kernels by the machine.
 */
#include <dlfcn.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/* llvm::StringRef */
struct text {
	const char *data;
	size_t length;
};

/* llvm::StringMap<bool>: buckets that are empty, hold what was erased, or point to an entry; the key stands `item_bytes` into it. */
struct entry {
	size_t key_length;
	bool value;
};
struct map {
	struct entry **buckets;
	unsigned n_buckets, n_items, n_erased, item_bytes;
};

struct text _ZN4llvm3sys14getHostCPUNameEv(void);
bool _ZN4llvm3sys18getHostCPUFeaturesERNS_9StringMapIbNS_15MallocAllocatorEEE(struct map *features);

struct text _ZN4llvm3sys14getHostCPUNameEv(void)
{
	return (struct text){ "haswell", 7 };
}

bool _ZN4llvm3sys18getHostCPUFeaturesERNS_9StringMapIbNS_15MallocAllocatorEEE(struct map *features)
{
	void *llvm = dlopen("libLLVM-15.so.1", RTLD_LAZY | RTLD_NOLOAD);
	bool (*real)(struct map *) = (bool (*)(struct map *))dlsym(llvm, "_ZN4llvm3sys18getHostCPUFeaturesERNS_9StringMapIbNS_15MallocAllocatorEEE");
	const bool known = real(features);

	for (unsigned i = 0; i < features->n_buckets; i++) {
		struct entry *e = features->buckets[i];

		/* Erased: all but the lowest bits set. */
		if (e && (size_t)e < (size_t)-16 && strncmp((const char *)e + features->item_bytes, "avx512", 6) == 0)
			e->value = false;
	}
	return known;
}
