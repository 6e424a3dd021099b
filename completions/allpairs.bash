# Completion of the command allpairs for bash; made by 'allpairs completion bash'.

_allpairs() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}
  local words='' options='' files='' before=''
  COMPREPLY=()
  ((COMP_CWORD > 1)) || command=''
  if [[ $current == = ]]; then
    current=''
  elif [[ $previous == = ]]; then
    previous=${COMP_WORDS[COMP_CWORD - 2]}
  elif [[ $current == --*=* ]]; then
    previous=${current%%=*} before=${current%%=*}= current=${current#*=}
  fi
  case $command in
    '') words='detect join plan info elements track view report generate bench completion help -h --help -V --version' ;;
    help) words='detect join plan info elements track view report generate bench completion' ;;
    detect)
      case $previous in
        --data) files=-d ;;
        --sofa) words='20.06 26.12' ;;
        --max-memory) return ;;
        --input-format) return ;;
        --distance) return ;;
        --box) return ;;
        --clearance) return ;;
        --min-depth) return ;;
        --strategy) words='auto exhaustive bvh' ;;
        --threads) return ;;
        --fail-on) words='pair clash' ;;
        --why) return ;;
        --format) words='table csv json npy' ;;
        -o | --output) files=-f ;;
        --color) words='auto always never' ;;
        *)
          options='-h --help --recursive --partial --data --sofa --allow-outside --max-memory --input-format --between-inputs --distance --box --clearance --min-depth --strategy --threads --verify --exact --worlds --fail-on --why --format -o --output --color'
          files=-f
          ;;
      esac
      ;;
    join)
      case $previous in
        --with) files=-f ;;
        --memory) return ;;
        --distance) return ;;
        --box) return ;;
        --margins) files=-f ;;
        --groups) files=-f ;;
        --categories) files=-f ;;
        --masks) files=-f ;;
        --with-margins) files=-f ;;
        --with-groups) files=-f ;;
        --with-categories) files=-f ;;
        --with-masks) files=-f ;;
        --work) files=-d ;;
        --threads) return ;;
        -o | --output) files=-f ;;
        *)
          options='-h --help --with --memory --distance --box --margins --groups --categories --masks --with-margins --with-groups --with-categories --with-masks --work --resume --count --threads -o --output'
          files=-f
          ;;
      esac
      ;;
    plan)
      case $previous in
        --with) files=-f ;;
        --memory) return ;;
        --distance) return ;;
        --box) return ;;
        --margins) files=-f ;;
        --groups) files=-f ;;
        --categories) files=-f ;;
        --masks) files=-f ;;
        --with-margins) files=-f ;;
        --with-groups) files=-f ;;
        --with-categories) files=-f ;;
        --with-masks) files=-f ;;
        --work) files=-d ;;
        --ranks) return ;;
        --threads) return ;;
        *)
          options='-h --help --with --memory --distance --box --margins --groups --categories --masks --with-margins --with-groups --with-categories --with-masks --work --ranks --threads'
          files=-f
          ;;
      esac
      ;;
    info)
      case $previous in
        --data) files=-d ;;
        --sofa) words='20.06 26.12' ;;
        --max-memory) return ;;
        --input-format) return ;;
        --format) words='table json' ;;
        -o | --output) files=-f ;;
        *)
          options='-h --help --recursive --partial --data --sofa --allow-outside --max-memory --input-format --format -o --output'
          files=-f
          ;;
      esac
      ;;
    elements)
      case $previous in
        --distance) return ;;
        --threads) return ;;
        --format) words='table json' ;;
        --max-memory) return ;;
        --input-format) return ;;
        -o | --output) files=-f ;;
        *)
          options='-h --help --distance --between --threads --format --allow-outside --max-memory --input-format -o --output'
          files=-f
          ;;
      esac
      ;;
    track)
      case $previous in
        --distance) return ;;
        --threads) return ;;
        --format) words='table csv json npy' ;;
        --max-memory) return ;;
        --input-format) return ;;
        -o | --output) files=-f ;;
        *)
          options='-h --help --distance --threads --verify --format --allow-outside --max-memory --input-format -o --output'
          files=-f
          ;;
      esac
      ;;
    view)
      case $previous in
        --data) files=-d ;;
        --sofa) words='20.06 26.12' ;;
        --max-memory) return ;;
        --input-format) return ;;
        --distance) return ;;
        --box) return ;;
        --clearance) return ;;
        --min-depth) return ;;
        --group) words='body assembly file none' ;;
        --up) words='x y z' ;;
        --threads) return ;;
        -o | --output) files=-f ;;
        --port) return ;;
        *)
          options='-h --help --recursive --partial --data --sofa --allow-outside --max-memory --input-format --between-inputs --distance --box --clearance --min-depth --exact --boxes --group --up --threads --sequence -o --output --open --serve --port'
          files=-f
          ;;
      esac
      ;;
    report)
      case $previous in
        --data) files=-d ;;
        --sofa) words='20.06 26.12' ;;
        --max-memory) return ;;
        --input-format) return ;;
        --distance) return ;;
        --box) return ;;
        --clearance) return ;;
        --min-depth) return ;;
        --group) words='body assembly file none' ;;
        --up) words='x y z' ;;
        --threads) return ;;
        -o | --output) files=-d ;;
        --bcf) words='2.1 3.0' ;;
        --since) files=-f ;;
        --fail-on) words='pair clash new' ;;
        --pictures) return ;;
        --metres-per-unit) return ;;
        *)
          options='-h --help --recursive --partial --data --sofa --allow-outside --max-memory --input-format --between-inputs --distance --box --clearance --min-depth --exact --boxes --group --up --threads -o --output --force --bcf --since --fail-on --open --pictures --metres-per-unit'
          files=-f
          ;;
      esac
      ;;
    generate)
      case $previous in
        -n | --boxes) return ;;
        --seed) return ;;
        --frames) return ;;
        -o | --output) files=-f ;;
        *)
          options='-h --help -n --boxes --seed --sorted --frames -o --output'
          words='uniform clusters power-law city needles all-overlap mesh brownian free-fall rotating-gravity'
          ;;
      esac
      ;;
    bench)
      case $previous in
        -n | --boxes) return ;;
        --seed) return ;;
        --threads) return ;;
        --repetitions) return ;;
        --strategy) words='auto exhaustive bvh' ;;
        --instruction-set) return ;;
        *)
          options='-h --help -n --boxes --seed --sorted --threads --repetitions --unordered --count --strategy --instruction-set --json'
          words='uniform clusters power-law city needles all-overlap mesh' files=-f
          ;;
      esac
      ;;
    completion)
      case $previous in
        *)
          options='-h --help'
          words='bash zsh fish'
          ;;
      esac
      ;;
  esac
  if [[ -n $options && $current == -* ]]; then
    words=$options files=''
  fi
  if [[ -n $words ]]; then
    mapfile -t COMPREPLY < <(compgen -P "$before" -W "$words" -- "$current")
  fi
  if [[ -n $files ]]; then
    compopt -o filenames 2>/dev/null
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -P "$before" "$files" -- "$current")
  fi
}

complete -F _allpairs allpairs
