int signorini_abi_version(void) { return 2; }
