/* Two threads that count without a lock: where helgrind is on, it says so, and the program must fail. */

#include <pthread.h>
#include <stddef.h>

static long count;

static void *work(void *argument)
{
    for (int i = 0; i < 1000; i++) count++;
    return argument;
}

int main(void)
{
    pthread_t threads[2];
    for (int i = 0; i < 2; i++)
        if (pthread_create(&threads[i], NULL, work, NULL)) return 2;
    for (int i = 0; i < 2; i++) pthread_join(threads[i], NULL);
    return count < 1000;
}
