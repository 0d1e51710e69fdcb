/* A program whose addresses have 32 bits, as it says here: the header refuses it in a sentence. */
#include <stdint.h>
#undef UINTPTR_MAX
#define UINTPTR_MAX 0xffffffffu
#include <signorini.h>
